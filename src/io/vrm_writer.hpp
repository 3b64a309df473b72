#pragma once

#include <string>

#include <skelgen/applications/rig.hpp>
#include <skelgen/io/scene_looks.hpp>

#include "rig_scene.hpp"

namespace skelgen::io::detail {

/// Writes VRM 1.0's extensions into a rig's scene, of the given humanoid's bones: who made the avatar and what its
/// licence is, expressions, look-at, first person and spring bones, as the looks have them from their file; of these
/// what goes by nodes that the scene has. `name`: the avatar's where the looks know none. The joints must have VRM's
/// names.
void add_vrm(RigScene& scene, const applications::Rig<double>& rig, const SceneLooks& looks, const std::string& name,
             Json human_bones);

/// How many of the looks' springs go by bones that no rig of human21 has.
[[nodiscard]] std::size_t count_lost_springs(const SceneLooks& looks);

} // namespace skelgen::io::detail
