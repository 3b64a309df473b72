#pragma once

#include <skelgen/core/curve_graph.hpp>
#include <skelgen/core/mesh.hpp>

namespace skelgen {

/// The surface as a graph whose shortest paths exceed geodesic distances by a few per cent at most: its edges, and the
/// diagonals of unfolded neighbouring faces. `mesh` must be edge-manifold. O(n log n).
[[nodiscard]] CurveGraph<double> surface_graph(const TriangleMesh<double>& mesh);

/// Largest geodesic distance on a connected surface, estimated by sweeps from end to end. O(n log n).
[[nodiscard]] double geodesic_diameter(const CurveGraph<double>& surface);

} // namespace skelgen
