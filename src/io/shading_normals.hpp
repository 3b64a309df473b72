#pragma once

#include <skelgen/core/mesh.hpp>

namespace skelgen::io::detail {

/// Unit normals of vertices to shade a mesh by: vertices at equal places, as at the seams of textures, share theirs,
/// unless an edge of more than 60 degrees runs there. Up for vertices without area. O(n log n).
[[nodiscard]] Points<double> shading_normals(const TriangleMesh<double>& mesh);

} // namespace skelgen::io::detail
