#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include <skelgen/core/kinematic_skeleton.hpp>

#include "soup.hpp"

namespace skelgen::damage {

inline constexpr std::size_t limb_count = 14;

/// In the order of the labels of `cut_limbs`.
inline constexpr std::array<const char*, limb_count> limb_names{
    "trunk",      "head",       "left_upper_arm", "left_forearm", "left_hand",   "right_upper_arm", "right_forearm",
    "right_hand", "left_thigh", "left_calf",      "left_foot",    "right_thigh", "right_calf",      "right_foot"};

/// For each face the limb that it belongs to. The surface is cut across the bones at neck, shoulders, elbows, wrists,
/// hips, knees and ankles: at each along the ring of faces there that parts it in two. O(faces log faces).
/// \throws Error bad_input when the skeleton lacks a joint, or no such ring is found (limbs that are grown together).
[[nodiscard]] std::vector<std::size_t> cut_limbs(const Soup& soup, const KinematicSkeleton<double>& skeleton);

/// \throws Error bad_input when there is no such joint.
[[nodiscard]] Vec3 joint_position(const KinematicSkeleton<double>& skeleton, const std::string& name);

} // namespace skelgen::damage
