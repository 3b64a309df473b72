#pragma once

#include <string>

#include <skelgen/core/mesh.hpp>
#include <skelgen/io/scene_looks.hpp>

namespace skelgen::io::detail {

/// A GLB file (Khr21 section 4) with this mesh as its one node: positions as floats, indices as 32-bit integers.
/// Linear. \throws Error usage when a coordinate is too large for a float, or there are no vertices or faces: glTF has
/// no way to write nothing.
[[nodiscard]] std::string format_glb(const Points<double>& vertices, const Triangles& faces);

/// The same with smooth normals and the looks of the scene that it was made of. \throws Error usage also when these are
/// those of another mesh.
[[nodiscard]] std::string format_glb(const TriangleMesh<double>& mesh, const SceneLooks& looks);

} // namespace skelgen::io::detail
