#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <skelgen/io/scene_looks.hpp>

#include "gltf_file.hpp"

namespace skelgen::io::detail {

/// What VRM (0.x or 1.0) says of an avatar, in the terms of VRM 1.0: an object with "meta", "expressions", "lookAt",
/// "firstPerson" and "springBone", as far as there are some. Nodes have the numbers that they have in the file, and
/// those which bones are on are in "bones", by VRM 1.0's names; instead of places within bones there are those in the
/// scene: "eyes" in "lookAt", "offset" and "tail" in shapes of colliders. Null where the file is no VRM.
struct VrmData {
    GltfValue::Json json;
    std::vector<std::string> left_out; ///< what VRM has beside, a phrase each
};

/// Reads all that; what is of no sound shape is left out. `objects`: of the scene. `node_matrices`: where the file's
/// nodes are. Linear.
[[nodiscard]] VrmData read_vrm(const GltfFile& file, const std::vector<SceneObject>& objects,
                               const std::vector<Eigen::Matrix4d>& node_matrices);

/// What an avatar's licence forbids, by its "meta": "redistribution and modification"; empty where nothing of that.
[[nodiscard]] std::string forbidden_by(const GltfValue::Json& meta);

} // namespace skelgen::io::detail
