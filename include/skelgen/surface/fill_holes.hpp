#pragma once

#include <vector>

#include <skelgen/core/mesh.hpp>

namespace skelgen::surface {

/// A surface whose small holes are closed.
template <typename Scalar = double>
struct FilledSurface {
    TriangleMesh<Scalar> mesh;          ///< the old vertices and faces first, as they were
    int filled = 0;                     ///< holes closed
    int open = 0;                       ///< holes left
    double open_area = 0;               ///< of the lids that would close the holes left, part of the surface's area
    std::vector<std::vector<int>> rims; ///< per hole closed the vertices around it, in order
};

/// Closes the holes of a manifold surface but for those whose lids have more than `largest` of the surface's area. A
/// lid goes on as the surface does around the hole (triangulate_rim); a fan around a new vertex in the middle of the
/// rim closes holes with too many edges for that, more than 500 together, or where no such lid exists. O(n log n)
/// besides. `at_holes`: per vertex, whether it is one around a hole that may be closed; holes around which there are
/// others stay open. Empty: all may be.
template <typename Scalar>
[[nodiscard]] FilledSurface<Scalar> fill_holes(const TriangleMesh<Scalar>& mesh, double largest,
                                               const std::vector<bool>& at_holes = {});

} // namespace skelgen::surface

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/surface/impl/fill_holes.hpp>
#endif
