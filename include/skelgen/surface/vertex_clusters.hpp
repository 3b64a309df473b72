#pragma once

#include <vector>

#include <skelgen/core/mesh.hpp>

namespace skelgen::surface {

/// A coarse surface of some of a fine one's vertices, and what they stand for.
template <typename Scalar = double>
struct ClusteredMesh {
    TriangleMesh<Scalar> mesh;
    std::vector<int> source;  ///< per vertex that of the fine surface, at the same place
    std::vector<int> cluster; ///< per vertex of the fine surface that of the mesh which stands for it
};

/// A surface in about so many faces, or in its own where those are fewer: its vertices are clustered in the cells of a
/// grid (RB93) along the surface's principal axes, those of a cell that hang together in it; of each cluster the vertex
/// in its midst stays. A cluster that is no disc, or would make the surface other than it was, is not made: both
/// surfaces are of the same kind, have the same boundaries, and are the same however the fine one is turned or
/// numbered. `mesh` must be manifold: each edge has two faces, of one orientation, or one; each vertex one fan of them.
/// O(n). \throws Error bad_input when the surface has no area.
template <typename Scalar>
[[nodiscard]] ClusteredMesh<Scalar> cluster_vertices(const TriangleMesh<Scalar>& mesh, Eigen::Index faces);

} // namespace skelgen::surface

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/surface/impl/vertex_clusters.hpp>
#endif
