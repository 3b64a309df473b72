#pragma once

#include <string>
#include <vector>

#include "gltf_data.hpp"
#include "scene_pose.hpp"

namespace skelgen::io::detail {

/// The channels of the animation with this name or, where none has it, this number counted from 1.
/// \throws Error usage, listing those there are, when there is no such animation; bad_input when it is not sound.
[[nodiscard]] std::vector<AnimationChannel> read_animation(GltfData& data, const std::string& name);

} // namespace skelgen::io::detail
