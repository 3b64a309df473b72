#include <skelgen/io/rig_formats.hpp>

#include <array>
#include <utility>

#include <skelgen/core/error.hpp>
#include <skelgen/io/atomic_file.hpp>

#include "file_extension.hpp"
#include "number_text.hpp"
#include "rig_scene.hpp"

namespace skelgen::io {
namespace {

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
        if (names[j] == name_of(joints[j], JointNames::vrm)) bones[names[j]] = {{"node", nodes[j]}};
    for (const char* bone : bones_of_a_humanoid)
        if (!bones.contains(bone))
            refuse(std::string("VRM asks for the bone ") + bone + ", which it has not; write GLB");
    return bones;
}

/// The lines of a joint and of all below it.
class BvhWriter {
public:
    BvhWriter(const Rig<double>& rig, const std::vector<std::string>& names)
        : rig_(&rig), names_(&names), scale_(rig.unit_is_known ? 100.0 : 1.0) {}

    std::string write() {
        text_ = "HIERARCHY\n";
        append_joint(0, "");
        text_ += "MOTION\nFrames: 1\nFrame Time: 0.033333\n";
        append_place(scale_ * rig_->joints.front().position);
        for (std::size_t j = 0; j < rig_->joints.size(); ++j) append_place(Eigen::Vector3d::Zero());
        text_.back() = '\n';
        return text_;
    }

private:
    [[nodiscard]] Eigen::Vector3d offset_from_parent(const RigJoint<double>& joint) const {
        return joint.position - rig_->joints[static_cast<std::size_t>(joint.parent)].position;
    }

    void append_place(const Eigen::Vector3d& place) {
        detail::append_point(text_, place);
        text_ += ' ';
    }

    void append_offset(const std::string& indent, const Eigen::Vector3d& offset) {
        text_ += indent + "OFFSET ";
        detail::append_point(text_, Eigen::Vector3d(scale_ * offset));
        text_ += '\n';
    }

    void append_joint(std::size_t j, const std::string& indent) {
        const RigJoint<double>& joint = rig_->joints[j];
        const bool is_root = joint.parent < 0;
        const std::string inner = indent + "\t";
        text_ += indent + (is_root ? "ROOT " : "JOINT ") + (*names_)[j] + "\n" + indent + "{\n";
        // Where the root is, the motion says: readers disagree on whether its offset comes on top.
        append_offset(inner, is_root ? Eigen::Vector3d::Zero() : offset_from_parent(joint));
        text_ += inner + (is_root ? "CHANNELS 6 Xposition Yposition Zposition " : "CHANNELS 3 ") +
                 "Zrotation Xrotation Yrotation\n";
        bool is_end = true;
        for (std::size_t child = j + 1; child < rig_->joints.size(); ++child) {
            if (rig_->joints[child].parent != static_cast<int>(j)) continue;
            append_joint(child, inner);
            is_end = false;
        }
        if (is_end) {
            text_ += inner + "End Site\n" + inner + "{\n";
            append_offset(inner + "\t", joint.end - joint.position);
            text_ += inner + "}\n";
        }
        text_ += indent + "}\n";
    }

    const Rig<double>* rig_;
    const std::vector<std::string>* names_;
    double scale_;
    std::string text_;
};

} // namespace

std::string rig_to_glb(const Rig<double>& rig, JointNames names, const SceneLooks& looks) {
    return detail::format_scene(detail::make_rig_scene(rig, names_of(rig.joints, names), looks));
}

std::string rig_to_vrm(const Rig<double>& rig, const std::string& name, const SceneLooks& looks) {
    if (rig.rest != applications::RestPose::t_pose) refuse("VRM's rest pose is the T-pose; make the rig in that");
    if (name.empty()) refuse("VRM asks for a name of the avatar");
    const std::vector<std::string> names = names_of(rig.joints, JointNames::vrm);
    detail::RigScene scene = detail::make_rig_scene(rig, names, looks);
    scene.json["extensionsUsed"].push_back("VRMC_vrm");
    scene.json["extensions"]["VRMC_vrm"] = {
        {"specVersion", "1.0"},
        {"meta",
         {{"name", name}, {"authors", Json::array({"unknown"})}, {"licenseUrl", "https://vrm.dev/licenses/1.0/"}}},
        {"humanoid", {{"humanBones", describe_humanoid(names, scene.joint_nodes, rig.joints)}}}};
    return detail::format_scene(std::move(scene));
}

std::string rig_to_bvh(const Rig<double>& rig, JointNames names) {
    const std::vector<std::string> all = names_of(rig.joints, names);
    return BvhWriter(rig, all).write();
}

std::optional<RigFormat> rig_format_of(const std::filesystem::path& path) {
    constexpr std::array<std::string_view, 3> extensions{".glb", ".vrm", ".bvh"};
    const auto found = detail::find_extension(path, extensions);
    if (!found) return std::nullopt;
    return static_cast<RigFormat>(*found);
}

void write_rig(const std::filesystem::path& path, const Rig<double>& rig, JointNames names, const SceneLooks& looks) {
    const std::optional<RigFormat> format = rig_format_of(path);
    if (!format) refuse("its name must end in .glb, .vrm or .bvh");
    switch (*format) {
    case RigFormat::glb:
        return write_file_atomically(path, rig_to_glb(rig, names, looks));
    case RigFormat::vrm:
        return write_file_atomically(path, rig_to_vrm(rig, path.stem().string(), looks));
    case RigFormat::bvh:
        return write_file_atomically(path, rig_to_bvh(rig, names));
    }
}

} // namespace skelgen::io
