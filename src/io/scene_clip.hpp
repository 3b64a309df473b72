#pragma once

#include <optional>
#include <string>
#include <vector>

#include <skelgen/applications/motion_clip.hpp>

#include "scene_pose.hpp"

namespace skelgen::io::detail {

/// The nodes of a scene that are bones of a skeleton, and how an animation moves them.
struct SceneMotion {
    std::vector<SceneNode> nodes;
    std::vector<std::string> names;         ///< one per node
    std::vector<bool> is_bone;              ///< one per node; those above bones count, too
    std::vector<AnimationChannel> channels; ///< of any of the nodes
};

/// What is wanted of a scene.
struct ClipOfScene {
    std::string animation;      ///< its name or number; empty: none
    std::optional<double> time; ///< as it is then, alone
    bool isolated = false;      ///< as `ReadMeshOptions::isolated`
};

/// The skeleton that moves, as a clip of 30 frames a second: at rest as the nodes are stored, without rotations, each
/// joint where it is in the scene. With a time: at rest as it is then, for one frame. O(frames nodes). \throws Error
/// bad_input where there is no bone, it takes more than ten hours, or nodes or channels are not sound.
[[nodiscard]] applications::MotionClip clip_of(SceneMotion motion, std::optional<double> time = std::nullopt);

} // namespace skelgen::io::detail
