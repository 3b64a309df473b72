#pragma once

#include <optional>
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
    /// Per mesh, which is that of the node of the same number, which of the looks' objects it is; none: they have none.
    std::vector<std::optional<std::size_t>> objects;
};

/// The rig as a scene: first the skinned meshes with their looks, then come the joints, by the given names. The
/// buffer's own parts of the JSON are not in it yet. \throws Error usage when there are no faces, a coordinate is too
/// large for a float, or the looks are those of another mesh.
[[nodiscard]] RigScene make_rig_scene(const applications::Rig<double>& rig, const std::vector<std::string>& names,
                                      const SceneLooks& looks);

/// The bytes of a GLB file with the scene.
[[nodiscard]] std::string format_scene(RigScene scene);

} // namespace skelgen::io::detail
