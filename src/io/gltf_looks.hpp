#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include <skelgen/io/scene_looks.hpp>

#include "gltf_data.hpp"
#include "gltf_parser.hpp"

namespace skelgen::io::detail {

/// How the parts of a scene look, in the order of its vertices and faces: `parse_gltf` tells which these are. Reads
/// texture coordinates, normals and pictures. \throws Error bad_input when something does not hold together; what
/// `load` throws.
[[nodiscard]] SceneLooks read_gltf_looks(std::string_view bytes, const ReadMeshOptions& options,
                                         const LoadCompanion& load);

} // namespace skelgen::io::detail
