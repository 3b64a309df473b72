#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <skelgen/core/mesh.hpp>

namespace skelgen::io {

/// Red, green and blue, each 0 to 255.
using ByteColour = std::array<std::uint8_t, 3>;

/// What a coloured mesh says of its vertices and faces beside where they are.
struct MeshColours {
    std::vector<ByteColour> vertices; ///< one for each vertex
    std::vector<int> vertex_labels;   ///< one for each vertex, or none at all
    std::vector<int> face_labels;     ///< one for each face, or none at all
};

/// The bytes of a PLY file, binary little-endian: x, y, z as doubles, red, green, blue as bytes, and, where they are
/// given, `label` as int of vertices and faces. \throws Error usage when a list has another length than it must, or a
/// coordinate is not finite. O(n).
[[nodiscard]] std::string format_coloured_ply(const TriangleMesh<double>& mesh, const MeshColours& colours);

/// Writes `format_coloured_ply`, wholly or not at all.
/// \throws Error as `format_coloured_ply` and `write_file_atomically`.
void write_coloured_ply(const std::filesystem::path& path, const TriangleMesh<double>& mesh,
                        const MeshColours& colours);

/// A colour for each part of a body by its name: what is on the left is blue to green, on the right yellow to red, the
/// trunk grey to violet; any two can be told apart.
[[nodiscard]] std::vector<ByteColour> part_colours(const std::vector<std::string>& parts);

} // namespace skelgen::io
