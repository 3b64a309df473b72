#pragma once

#include <vector>

#include <skelgen/core/mesh.hpp>

namespace skelgen::surface {

/// A surface cut in places, and where its vertices come from. The old vertices come first and keep their indices; those
/// along a cut are there twice, and both draw back from it, halfway to their neighbours. The holes are closed by fans
/// around new vertices; holes that were there before stay.
template <typename Scalar = double>
struct CutSurface {
    TriangleMesh<Scalar> mesh;
    std::vector<int> source; ///< per vertex that of the original mesh at the same place, -1 where it closes a hole
};

/// Separates two parts of a surface, each a list of vertices, along the border of the first where they meet. `mesh`
/// must be edge-manifold. O(n log n).
template <typename Scalar>
[[nodiscard]] CutSurface<Scalar> cut_surface(const TriangleMesh<Scalar>& mesh, const std::vector<int>& part,
                                             const std::vector<int>& other);

/// Cuts a surface along closed paths of its edges, each a list of vertices in order; no vertex may be on two, or twice
/// on one, or at a boundary. `mesh` must be manifold, `adjacency` as from core::face_adjacency(mesh.faces). O(n log n).
template <typename Scalar>
[[nodiscard]] CutSurface<Scalar> cut_along(const TriangleMesh<Scalar>& mesh, const Triangles& adjacency,
                                           const std::vector<std::vector<int>>& loops);

} // namespace skelgen::surface

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/surface/impl/cut_surface.hpp>
#endif
