#pragma once

#include <skelgen/core/mesh.hpp>

namespace skelgen {

/// Largest geodesic distance on a connected manifold mesh, estimated within a few per cent: shortest paths over the edges
/// and over the diagonals of unfolded neighbouring faces, swept from end to end. O(n log n).
[[nodiscard]] double geodesic_diameter(const TriangleMesh<double>& mesh);

} // namespace skelgen
