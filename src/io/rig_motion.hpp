#pragma once

#include <vector>

#include <skelgen/applications/animation.hpp>

#include "rig_scene.hpp"

namespace skelgen::io::detail {

/// Adds animations of a rig to its scene: the root is moved and every joint turned, linearly between frames. \throws
/// Error usage when a pose has not as many axes as there are joints, or the times of the frames are no rising floats.
void add_animations(RigScene& scene, const applications::Rig<double>& rig,
                    const std::vector<applications::Animation<double>>& animations);

} // namespace skelgen::io::detail
