#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include <skelgen/applications/motion_clip.hpp>
#include <skelgen/io/read_mesh.hpp>

namespace skelgen::io {

/// Reads how a skeleton moves: BVH (`parse_bvh`); the first animation of a scene, GLB, glTF, VRM, VRMA, FBX or DAE, 30
/// frames a second. Of a scene the joints of skins and all that is animated are joints; where a VRM or VRMA says which
/// node is which bone, these alone, by VRM's names. `isolated`: as `ReadMeshOptions::isolated`. \throws Error bad_input
/// where the file is damaged or nothing moves in it; as `read_file`.
[[nodiscard]] applications::MotionClip read_clip(const std::filesystem::path& path, bool isolated = false);

/// The same of a file's content; what is in files of their own is not found.
[[nodiscard]] applications::MotionClip parse_clip(std::string_view content, bool isolated = false);

/// The skeleton of the rig that a scene's file has, where `read_mesh` with these options shows it: a clip of one frame,
/// at rest. None where the file is no scene, or has no skin. \throws Error as `read_mesh`.
[[nodiscard]] std::optional<applications::MotionClip> read_rig(const std::filesystem::path& path,
                                                               const ReadMeshOptions& options = {});

} // namespace skelgen::io

namespace skelgen {
using io::read_clip;
} // namespace skelgen
