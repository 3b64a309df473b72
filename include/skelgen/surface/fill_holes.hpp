#pragma once

#include <vector>

#include <skelgen/core/mesh.hpp>

namespace skelgen::surface {

/// A surface whose small holes are closed.
template <typename Scalar = double>
struct FilledSurface {
    TriangleMesh<Scalar> mesh; ///< the old vertices and faces first, as they were
    int filled = 0;            ///< holes closed
    int open = 0;              ///< holes left
    double open_area = 0;      ///< of the fans that would close the holes left, part of the surface's area
};

/// Closes the holes of a manifold surface by fans around a new vertex in the middle of the rim (a hole of three edges
/// by one face), but for those whose fan has more than `largest` of the surface's area. O(n log n).
template <typename Scalar>
[[nodiscard]] FilledSurface<Scalar> fill_holes(const TriangleMesh<Scalar>& mesh, double largest);

} // namespace skelgen::surface

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/surface/impl/fill_holes.hpp>
#endif
