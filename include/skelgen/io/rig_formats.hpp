#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <skelgen/applications/animation.hpp>
#include <skelgen/applications/rig.hpp>
#include <skelgen/io/scene_looks.hpp>

namespace skelgen::io {

/// Whose names the joints of a file have.
enum class JointNames {
    skelgen,
    smpl,
    mixamo,
    vrm,
    smplx,
    unity,
    godot,
    unreal,
    rigify,
    mesh2motion_fox,
    mesh2motion_horse
};

/// The names of those conventions, as `JointNames` has them: "skelgen", ...
[[nodiscard]] std::optional<JointNames> joint_names_named(std::string_view name);

/// All of these names.
[[nodiscard]] std::vector<std::string> joint_names();

/// What a convention calls a joint; the joint's own name where it has none.
[[nodiscard]] std::string name_of(const applications::RigJoint<double>& joint, JointNames names);

/// What a convention calls each joint of a rig, in their order. Where a role is there several times, all but the
/// first keep their own names. O(joints^2).
[[nodiscard]] std::vector<std::string> names_of(const std::vector<applications::RigJoint<double>>& joints,
                                                JointNames names);

/// A GLB file (Khr21) with the rig: one skinned mesh, its vertices in the rig's order, behind them the looks' copies of
/// them. Normals are the looks' ones, turned as the rig's vertices are. Else they are smooth but for edges sharper than
/// 60 degrees between vertices at equal places. The joints are nodes with their axes and, in "extras", their
/// confidence; there are inverse bind matrices and four influences a vertex. The file has the looks of the scene that
/// the rig was made of, and the animations; those without frames are left out. Linear. \throws Error usage when there
/// are no faces, a coordinate is too large for a float, the looks are those of another mesh, or an animation is that of
/// another rig.
[[nodiscard]] std::string rig_to_glb(const applications::Rig<double>& rig, JointNames names = JointNames::skelgen,
                                     const SceneLooks& looks = {},
                                     const std::vector<applications::Animation<double>>& animations = {});

/// The same with VRM 1.0's extension VRMC_vrm: which node is which bone of a humanoid, and a name for the avatar.
/// Joints are named as VRM names them. \throws Error usage also when the rig does not stand in the T-pose, which VRM
/// asks for, or a bone that it asks for is missing; or the name is empty.
[[nodiscard]] std::string rig_to_vrm(const applications::Rig<double>& rig, const std::string& name,
                                     const SceneLooks& looks = {});

/// The same as `rig_to_glb` in FBX (binary, 7.4): centimetres where the unit is known, else the rig's own; +Y up,
/// facing +Z; joints as bones (LimbNode) with a bind pose. Morph targets, pictures, custom properties ("extras") and
/// animations are in it; of materials colours, opacity, normal map and emission, and numbers for roughness and
/// metalness. \throws Error as `rig_to_glb`, and usage when the file would be 4 GiB or larger.
[[nodiscard]] std::string rig_to_fbx(const applications::Rig<double>& rig, JointNames names = JointNames::skelgen,
                                     const SceneLooks& looks = {},
                                     const std::vector<applications::Animation<double>>& animations = {});

/// The skeleton as BVH: offsets in the rest pose, centimetres (where the unit is known, else the rig's own), +Y up.
/// Channels are in the order Z, X, Y, and one frame moves nothing. O(joints).
[[nodiscard]] std::string rig_to_bvh(const applications::Rig<double>& rig, JointNames names = JointNames::skelgen);

/// The formats that rigs are written in.
enum class RigFormat { glb, vrm, bvh, fbx };

/// The format that the extension of `path` stands for, whatever its case; none if it is no rig's.
[[nodiscard]] std::optional<RigFormat> rig_format_of(const std::filesystem::path& path);

/// What of a scene's looks is lost when a rig of it is written in a format, a phrase each ("2 animations").
[[nodiscard]] std::vector<std::string> left_out_of(RigFormat format, const SceneLooks& looks);

/// Writes one of the above by the extension of `path`, whatever its case: .glb, .vrm (named as the file), .bvh or .fbx.
/// Whole or not at all (see `write_file_atomically`). \throws Error usage also when the extension is none of these; as
/// `write_file_atomically` when the file cannot be written.
void write_rig(const std::filesystem::path& path, const applications::Rig<double>& rig,
               JointNames names = JointNames::skelgen, const SceneLooks& looks = {});

} // namespace skelgen::io

namespace skelgen {
using io::write_rig;
} // namespace skelgen
