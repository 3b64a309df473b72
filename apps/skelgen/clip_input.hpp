#pragma once

#include <filesystem>

#include <skelgen/applications/animation.hpp>

namespace skelgen::cli {

/// Reads a BVH file and has the rig, of the template human21, move as its skeleton does; the animation has the file's
/// name. \throws Error with the file's name in front, bad_input where it is damaged or its skeleton is no body's.
[[nodiscard]] applications::Animation<double> follow_clip(const std::filesystem::path& file,
                                                          const applications::Rig<double>& rig);

} // namespace skelgen::cli
