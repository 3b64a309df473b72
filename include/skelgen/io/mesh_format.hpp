#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace skelgen::io {

/// The mesh formats that are read; `is_written` says which are written, too.
enum class MeshFormat { off, obj, ply, stl, glb, gltf, vrm, fbx, dae };

/// Whether meshes can be written in this format: OFF, OBJ, PLY, STL, GLB and FBX.
[[nodiscard]] bool is_written(MeshFormat format);

/// The formats' extensions in the order of `MeshFormat`: ".off", ".obj", ...
[[nodiscard]] std::span<const std::string_view> mesh_extensions();

/// The extensions as users read them in messages: ".off, .obj, ... or .dae".
[[nodiscard]] std::string mesh_extensions_text();

/// Those of the formats that are written, likewise.
[[nodiscard]] std::string written_mesh_extensions_text();

/// The format that the extension of `path` stands for, whatever its case; none if it is no mesh format's. A compressed
/// file ("body.ply.gz") has the format of what is in it. The file need not exist.
[[nodiscard]] std::optional<MeshFormat> mesh_format_of(const std::filesystem::path& path);

/// The format with this name: its extension without the dot, whatever its case.
[[nodiscard]] std::optional<MeshFormat> mesh_format_named(std::string_view name);

/// Whether the name says that the file is compressed: it ends in ".gz", whatever its case.
[[nodiscard]] bool has_gzip_extension(const std::filesystem::path& path);

/// The path without its extension; of a compressed file ("body.ply.gz") without both.
[[nodiscard]] std::filesystem::path without_extensions(const std::filesystem::path& path);

} // namespace skelgen::io
