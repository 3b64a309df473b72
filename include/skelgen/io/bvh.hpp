#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include <skelgen/applications/motion_clip.hpp>

namespace skelgen::io {

/// Reads a BVH file (MM01): one hierarchy of joints with offsets and channels in any order, and at least one frame.
/// Positions of joints below the root that come on top of their offsets, as some programs write them, get these added.
/// They are known by lying nearer to zero than to the offsets. Linear. \throws Error bad_input, naming the line, where
/// it is damaged: words or numbers that are missing, too many, or no usable numbers, a channel that a joint has twice.
/// It is so, too, with fewer or more numbers than frames and channels make, or several roots. No more is read than any
/// recording has: 5000 joints, 500 below each other, a million frames.
[[nodiscard]] applications::MotionClip parse_bvh(std::string_view text);

/// The same of a file. \throws Error also as `read_file`.
[[nodiscard]] applications::MotionClip read_bvh(const std::filesystem::path& path);

/// The clip as a BVH file, which reads back as the same but for the order of joints: each is followed by all that is
/// below it. A clip whose positions draw most bones to nothing may read back otherwise. Names must be such as
/// `parse_bvh` reads: in one line, without braces. O(joints + numbers). \throws Error usage when the clip has no joints
/// or several roots, and as `applications::validate`.
[[nodiscard]] std::string clip_to_bvh(const applications::MotionClip& clip);

} // namespace skelgen::io

namespace skelgen {
using io::read_bvh;
} // namespace skelgen
