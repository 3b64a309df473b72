#pragma once

#include <optional>
#include <string_view>

#include <skelgen/io/mesh_format.hpp>

namespace skelgen::io::detail {

/// How a mesh file is to be read; scenes come last.
enum class Encoding { off, obj, ply, stl_text, stl_binary, gltf, fbx, dae };

/// What a file's plain content is; where that says nothing, what the format says that its name or user gave. \throws
/// Error bad_input when neither tells.
[[nodiscard]] Encoding encoding_of(std::string_view content, std::optional<MeshFormat> format);

} // namespace skelgen::io::detail
