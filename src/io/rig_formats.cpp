#include <skelgen/io/rig_formats.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include <skelgen/core/error.hpp>
#include <skelgen/io/atomic_file.hpp>
#include <skelgen/io/bvh.hpp>

#include "fbx_writer.hpp"
#include "file_extension.hpp"
#include "rig_motion.hpp"
#include "rig_scene.hpp"
#include "vrm_writer.hpp"

namespace skelgen::io {
namespace {

using applications::ClipJoint;
using applications::MotionClip;
using applications::Rig;
using applications::RigJoint;
using detail::Json;

[[noreturn]] void refuse(const std::string& message) {
    throw Error(ErrorCode::usage, "the rig cannot be written: " + message);
}

/// The bones without which VRM 1.0 knows no humanoid.
constexpr std::array<const char*, 15> bones_of_a_humanoid{
    "hips",         "spine",         "head",          "leftUpperLeg",  "leftLowerLeg",
    "leftFoot",     "rightUpperLeg", "rightLowerLeg", "rightFoot",     "leftUpperArm",
    "leftLowerArm", "leftHand",      "rightUpperArm", "rightLowerArm", "rightHand"};

Json describe_humanoid(const std::vector<std::string>& names, const std::vector<std::size_t>& nodes,
                       const std::vector<RigJoint<double>>& joints) {
    Json bones;
    for (std::size_t j = 0; j < names.size(); ++j)
        // A root on the floor and bones of twists are no bones of a humanoid.
        if (names[j] == name_of(joints[j], JointNames::vrm) && names[j] != "root" && !names[j].ends_with("_twist"))
            bones[names[j]] = {{"node", nodes[j]}};
    for (const char* bone : bones_of_a_humanoid)
        if (!bones.contains(bone))
            refuse(std::string("VRM needs the bone ") + bone + ", which the rig lacks; write GLB");
    return bones;
}

/// Whether a rig stands in the T-pose, or near enough to it: its limbs are not farther off than those of people whom
/// one asks to stand so.
bool is_near_t_pose(const Rig<double>& rig) {
    if (rig.rest != applications::RestPose::as_is) return rig.rest == applications::RestPose::t_pose;
    constexpr double most = 25 * std::numbers::pi / 180;
    return std::all_of(rig.joints.begin(), rig.joints.end(), [&](const RigJoint<double>& joint) {
        const bool is_arm = joint.role == JointRole::shoulder || joint.role == JointRole::elbow;
        if (!is_arm && joint.role != JointRole::hip && joint.role != JointRole::knee) return true;
        const Eigen::Vector3d wanted = is_arm ? Eigen::Vector3d(sign_of(joint.side), 0, 0) : Eigen::Vector3d(0, -1, 0);
        return (joint.end - joint.position).normalized().dot(wanted) >= std::cos(most);
    });
}

/// The rig's skeleton as a clip of one frame that moves nothing, by these names.
MotionClip clip_of(const Rig<double>& rig, const std::vector<std::string>& names) {
    using enum applications::ClipChannel;
    const double scale = rig.unit_is_known ? 100 : 1; // centimetres
    MotionClip clip;
    for (std::size_t j = 0; j < rig.joints.size(); ++j) {
        const RigJoint<double>& joint = rig.joints[j];
        ClipJoint out{names[j], joint.parent, {}, {z_rotation, x_rotation, y_rotation}, std::nullopt};
        // Where the root is, the motion says: readers disagree on whether its offset comes on top.
        if (joint.parent < 0)
            out.channels = {x_position, y_position, z_position, z_rotation, x_rotation, y_rotation};
        else
            out.offset = scale * (joint.position - rig.joints[static_cast<std::size_t>(joint.parent)].position);
        const bool is_last = std::none_of(rig.joints.begin(), rig.joints.end(),
                                          [&](const auto& other) { return other.parent == static_cast<int>(j); });
        if (is_last) out.end = scale * (joint.end - joint.position);
        clip.joints.push_back(std::move(out));
    }
    clip.frames.setZero(1, static_cast<Eigen::Index>(3 + 3 * rig.joints.size()));
    clip.frames.leftCols<3>() = scale * rig.joints.front().position.transpose();
    return clip;
}

} // namespace

std::string rig_to_glb(const Rig<double>& rig, JointNames names, const SceneLooks& looks,
                       const std::vector<applications::Animation<double>>& animations) {
    detail::RigScene scene = detail::make_rig_scene(rig, names_of(rig.joints, names), looks);
    detail::add_animations(scene, rig, animations);
    return detail::format_scene(std::move(scene));
}

std::string rig_to_fbx(const Rig<double>& rig, JointNames names, const SceneLooks& looks,
                       const std::vector<applications::Animation<double>>& animations) {
    constexpr double centimetres = 100;
    detail::FbxOptions options;
    options.scale = rig.unit_is_known ? centimetres : 1;
    options.centimetres_per_unit = rig.unit_is_known ? 1 : centimetres;
    options.copies = looks.copies;
    for (const applications::Animation<double>& animation : animations)
        if (!animation.frames.empty()) options.seconds_per_frame.push_back(animation.seconds_per_frame);
    return detail::glb_to_fbx(rig_to_glb(rig, names, looks, animations), options);
}

std::string rig_to_vrm(const Rig<double>& rig, const std::string& name, const SceneLooks& looks) {
    if (!is_near_t_pose(rig)) refuse("VRM's rest pose is the T-pose; make the rig in that");
    if (name.empty()) refuse("VRM needs a name of the avatar; give one");
    const std::vector<std::string> names = names_of(rig.joints, JointNames::vrm);
    detail::RigScene scene = detail::make_rig_scene(rig, names, looks);
    detail::add_vrm(scene, rig, looks, name, describe_humanoid(names, scene.joint_nodes, rig.joints));
    return detail::format_scene(std::move(scene));
}

std::string rig_to_bvh(const Rig<double>& rig, JointNames names) {
    return clip_to_bvh(clip_of(rig, names_of(rig.joints, names)));
}

std::optional<RigFormat> rig_format_of(const std::filesystem::path& path) {
    constexpr std::array<std::string_view, 4> extensions{".glb", ".vrm", ".bvh", ".fbx"};
    const auto found = detail::find_extension(path, extensions);
    if (!found) return std::nullopt;
    return static_cast<RigFormat>(*found);
}

std::vector<std::string> left_out_of(RigFormat format, const SceneLooks& looks) {
    std::vector<std::string> out = looks.left_out;
    if (const std::size_t morphs = morph_target_count(looks); format == RigFormat::bvh && morphs > 0)
        out.push_back(std::to_string(morphs) + " morph targets (BVH has a skeleton alone)");
    if (format == RigFormat::fbx)
        if (const std::size_t pictures = detail::pictures_lost_in_fbx(looks.json); pictures > 0)
            out.push_back(std::to_string(pictures) + " pictures of roughness, metalness or shade (FBX has none; .glb)");
    if (looks.vrm.empty()) return out;
    if (format != RigFormat::vrm) {
        out.emplace_back("expressions, look-at, first person and spring bones (.vrm keeps them)");
    } else if (const std::size_t springs = detail::count_lost_springs(looks); springs > 0) {
        out.push_back(std::to_string(springs) + " springs (they swing bones that the rig does not have)");
    }
    return out;
}

void write_rig(const std::filesystem::path& path, const Rig<double>& rig, JointNames names, const SceneLooks& looks) {
    const std::optional<RigFormat> format = rig_format_of(path);
    if (!format) refuse("its name must end in .glb, .vrm, .bvh or .fbx");
    switch (*format) {
    case RigFormat::glb:
        return write_file_atomically(path, rig_to_glb(rig, names, looks));
    case RigFormat::vrm:
        return write_file_atomically(path, rig_to_vrm(rig, path.stem().string(), looks));
    case RigFormat::bvh:
        return write_file_atomically(path, rig_to_bvh(rig, names));
    case RigFormat::fbx:
        return write_file_atomically(path, rig_to_fbx(rig, names, looks));
    }
}

} // namespace skelgen::io
