#pragma once

#include <skelgen/core/curve_graph.hpp>
#include <skelgen/core/mesh.hpp>

namespace skelgen::core {

/// The surface as a graph whose shortest paths exceed geodesic distances by a few per cent at most: its edges, and the
/// diagonals of unfolded neighbouring faces. `mesh` must be edge-manifold, `adjacency` as from face_adjacency. O(n).
template <typename Scalar>
[[nodiscard]] SurfaceGraph<Scalar> surface_graph(const TriangleMesh<Scalar>& mesh, const Triangles& adjacency);

/// Largest geodesic distance on a connected surface, estimated by sweeps from end to end. O(n log n).
template <typename Scalar>
[[nodiscard]] Scalar geodesic_diameter(const SurfaceGraph<Scalar>& surface);

} // namespace skelgen::core

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/core/impl/geodesics.hpp>
#endif
