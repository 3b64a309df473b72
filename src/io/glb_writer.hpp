#pragma once

#include <string>

#include <skelgen/applications/skinning.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/io/scene_looks.hpp>

namespace skelgen::io::detail {

/// A GLB file (Khr21 section 4) with this mesh as its one node: positions as floats, indices as 32-bit integers.
/// Linear. \throws Error usage when a coordinate is too large for a float, or there are no vertices or faces: glTF has
/// no way to write nothing.
[[nodiscard]] std::string format_glb(const Points<double>& vertices, const Triangles& faces);

/// The same with normals and the looks of the scene that it was made of; the looks' own normals where it is known how
/// its vertices have been turned since, else smooth ones. \throws Error usage also when looks or turns are those of
/// another mesh.
[[nodiscard]] std::string format_glb(const TriangleMesh<double>& mesh, const SceneLooks& looks,
                                     const applications::VertexTurns<double>& turns);

} // namespace skelgen::io::detail
