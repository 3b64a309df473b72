#pragma once

#include <filesystem>
#include <optional>

namespace skelgen {

/// The mesh formats that are read and written.
enum class MeshFormat { off, obj, ply, stl };

/// The format that the extension of `path` stands for, whatever its case; none if it is no mesh format's. The file
/// need not exist.
[[nodiscard]] std::optional<MeshFormat> mesh_format_of(const std::filesystem::path& path);

} // namespace skelgen
