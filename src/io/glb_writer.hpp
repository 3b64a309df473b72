#pragma once

#include <string>

#include <skelgen/core/mesh.hpp>

namespace skelgen::io::detail {

/// A GLB file (Khr21 section 4) with this mesh as its one node: positions as floats, indices as 32-bit integers.
/// Linear. \throws Error usage when a coordinate is too large for a float, or there are no vertices or faces: glTF has
/// no way to write nothing.
[[nodiscard]] std::string format_glb(const Points<double>& vertices, const Triangles& faces);

} // namespace skelgen::io::detail
