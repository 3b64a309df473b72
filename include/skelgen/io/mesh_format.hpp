#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace skelgen::io {

/// The mesh formats that are read and written.
enum class MeshFormat { off, obj, ply, stl };

/// The formats' extensions in the order of `MeshFormat`: ".off", ".obj", ".ply", ".stl".
[[nodiscard]] std::span<const std::string_view> mesh_extensions();

/// The extensions as users read them in messages: ".off, .obj, .ply or .stl".
[[nodiscard]] std::string mesh_extensions_text();

/// The format that the extension of `path` stands for, whatever its case; none if it is no mesh format's. The file
/// need not exist.
[[nodiscard]] std::optional<MeshFormat> mesh_format_of(const std::filesystem::path& path);

} // namespace skelgen::io
