#pragma once

#include <optional>
#include <string_view>

#include <skelgen/io/scene_looks.hpp>

#include "gltf_data.hpp"

namespace skelgen::io::detail {

/// How the mesh of an OBJ file looks; none where it says nothing of that. O(n log n). \throws Error as `parse_obj`.
[[nodiscard]] std::optional<SceneLooks> read_obj_looks(std::string_view text, const LoadCompanion& load);

/// How the mesh of a PLY file looks, as `read_obj_looks`. Linear. \throws Error as `parse_ply`.
[[nodiscard]] std::optional<SceneLooks> read_ply_looks(std::string_view bytes);

} // namespace skelgen::io::detail
