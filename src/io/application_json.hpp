#pragma once

#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/io/skeleton_json.hpp>

#include "json_values.hpp"

/// What the files of all applications say.
namespace skelgen::io::detail {

[[nodiscard]] inline Json to_json(const SourceMesh& mesh) {
    return {{"file", valid_utf8(mesh.file)},
            {"vertices", mesh.vertices},
            {"faces", mesh.faces},
            {"geodesic_diameter", mesh.geodesic_diameter}};
}

[[nodiscard]] inline Json to_json(const Quality& quality) {
    Json warnings = Json::array();
    for (const std::string& warning : quality.warnings) warnings.push_back(valid_utf8(warning));
    return {{"sides_confidence", quality.sides_confidence}, {"warnings", warnings}};
}

} // namespace skelgen::io::detail
