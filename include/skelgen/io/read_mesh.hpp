#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include <skelgen/core/mesh.hpp>
#include <skelgen/io/mesh_format.hpp>

namespace skelgen::io {

/// Reads a triangle mesh: OFF (text, Geomview's binary), OBJ, PLY (text, binary of either byte order) or STL (text,
/// binary). What the file holds decides which it is; its extension only where that says nothing.
///
/// - Vertices and faces keep the file's order and indices; normals, colours and texture coordinates are dropped.
///   STL has no indices: corners at exactly the same position become one vertex.
/// - Polygons are cut into triangles (see `triangulate`). Triangles that name a vertex twice are left out.
/// - Nothing is repaired: pinched vertices, holes, several components and unused vertices come through as they are.
///
/// `Scalar` is float or double. Linear in the file's size; memory stays below a small multiple of it even if the
/// file's counts lie. Pipes can be read too.
/// \throws Error bad_input, naming the line or the byte, when there is no such file or it is none of these formats,
///         is cut short, holds more or less than it says, has a coordinate that is no finite number, a face with less
///         than 3 corners or with a vertex that does not exist, or no vertices or faces at all.
template <typename Scalar = double>
[[nodiscard]] TriangleMesh<Scalar> read_mesh(const std::filesystem::path& path);

/// As `read_mesh`, from the content of a file in memory. `extension` is the format to fall back on where the content
/// does not tell (OFF without its keyword, OBJ with unusual first words).
template <typename Scalar = double>
[[nodiscard]] TriangleMesh<Scalar> parse_mesh(std::string_view content,
                                              std::optional<MeshFormat> extension = std::nullopt);

} // namespace skelgen::io

namespace skelgen {
using io::read_mesh;
} // namespace skelgen
