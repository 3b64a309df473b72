#pragma once

#include <filesystem>

#include <skelgen/applications/animation.hpp>
#include <skelgen/applications/motion_clip.hpp>

namespace skelgen::cli {

/// A motion that a command has a body follow, and the file that it is from.
struct ClipInput {
    std::filesystem::path file;
    applications::MotionClip clip;
};

/// Reads a clip, as `io::read_clip`. \throws Error with the file's name in front, bad_input where it is damaged or its
/// joints are not known as a body's.
[[nodiscard]] ClipInput load_clip(const std::filesystem::path& file);

/// Has a rig, of the template human21 and perhaps with digits, move as the clip's skeleton does; digits are held. The
/// animation has the file's name. \throws Error bad_input with the file's name in front where the skeleton is held or
/// moves as no body can.
[[nodiscard]] applications::Animation<double> follow_clip(const ClipInput& input, const applications::Rig<double>& rig);

} // namespace skelgen::cli
