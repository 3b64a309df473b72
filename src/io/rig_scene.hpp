#pragma once

#include <string>
#include <vector>

#include <skelgen/io/rig_formats.hpp>

#include "gltf_buffer.hpp"

namespace skelgen::io::detail {

/// A glTF scene that is being written.
struct RigScene {
    Json json;
    GltfBuffer buffer;
    std::vector<std::size_t> joint_nodes; ///< per joint the index of its node
};

/// The rig as a scene: node 0 is the skinned mesh with its looks, then come the joints, by the given names. The
/// buffer's own parts of the JSON are not in it yet. \throws Error usage when there are no faces, a coordinate is too
/// large for a float, or the looks are those of another mesh.
[[nodiscard]] RigScene make_rig_scene(const applications::Rig<double>& rig, const std::vector<std::string>& names,
                                      const SceneLooks& looks);

/// The bytes of a GLB file with the scene.
[[nodiscard]] std::string format_scene(RigScene scene);

} // namespace skelgen::io::detail
