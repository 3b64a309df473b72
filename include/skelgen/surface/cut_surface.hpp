#pragma once

#include <vector>

#include <skelgen/core/mesh.hpp>

namespace skelgen::surface {

/// A surface cut in places, and where its vertices come from.
template <typename Scalar = double>
struct CutSurface {
    TriangleMesh<Scalar> mesh;
    std::vector<int> source; ///< per vertex that of the original mesh at the same place, -1 where it closes a hole
};

/// Separates two parts of a surface, each a list of vertices, along the border of the first where they meet: its
/// vertices there become two each, and the two holes are closed by fans around new vertices. The old vertices come
/// first and keep their indices; those along the cut draw back from it, halfway to their neighbours. Holes that were
/// there before stay. O(n log n).
template <typename Scalar>
[[nodiscard]] CutSurface<Scalar> cut_surface(const TriangleMesh<Scalar>& mesh, const std::vector<int>& part,
                                             const std::vector<int>& other);

} // namespace skelgen::surface

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/surface/impl/cut_surface.hpp>
#endif
