#pragma once

#include <filesystem>
#include <string>

#include <skelgen/extract.hpp>
#include <skelgen/render/scene.hpp>

namespace skelgen::cli {

/// Where the parts of a picture come from. Empty paths: the skeleton and its curve are extracted from the mesh.
struct SceneSources {
    std::filesystem::path mesh;
    std::filesystem::path skeleton; ///< skeleton file
    std::filesystem::path curve;    ///< curve file of any format that is read
    std::filesystem::path truth;    ///< file with true joints, shown as marks
    ExtractOptions extraction;
    std::string parts;                    ///< bones or body: the mesh in the colours of its parts; empty: not
    bool skeleton_may_be_missing = false; ///< then the curve alone is extracted, unless `curve` is given
};

/// Reads a mesh and all there is to show of it. A mesh in which no skeleton is found is still a scene: its `failure`
/// says why, and the curve skeleton is shown if there is one.
/// \throws Error, its text beginning with the file's name, when a file cannot be read.
[[nodiscard]] render::Scene load_scene(const SceneSources& sources);

} // namespace skelgen::cli
