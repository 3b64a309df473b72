#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include <skelgen/core/skeleton_template.hpp>
#include <skelgen/hands/digit.hpp>
#include <skelgen/io/rig_formats.hpp>

namespace skelgen::io {
namespace {

/// What conventions call the joints of a role. SMPL and VRM put the side in front ("left_", "left"), Mixamo "Left".
struct RoleNames {
    std::string_view smpl, mixamo, vrm;
};

/// In the order of JointRole.
constexpr std::array<RoleNames, 13> role_names{{{"pelvis", "Hips", "hips"},
                                                {"spine1", "Spine", "spine"},
                                                {"spine3", "Spine2", "chest"},
                                                {"neck", "Neck", "neck"},
                                                {"head", "Head", "head"},
                                                {"shoulder", "Arm", "UpperArm"},
                                                {"elbow", "ForeArm", "LowerArm"},
                                                {"wrist", "Hand", "Hand"},
                                                {"hand", "HandMiddle1", "MiddleProximal"},
                                                {"hip", "UpLeg", "UpperLeg"},
                                                {"knee", "Leg", "LowerLeg"},
                                                {"ankle", "Foot", "Foot"},
                                                {"foot", "ToeBase", "Toes"}}};

std::string with_side(Side side, const char* left, const char* right, std::string_view name) {
    const std::string prefix = side == Side::none ? "" : side == Side::left ? left : right;
    return prefix + std::string(name);
}

/// What conventions call a digit's joint; empty for another one, and where they are skelgen's own.
std::string digit_name(const applications::RigJoint<double>& joint, JointNames names) {
    const auto found = hands::digit_joint(split_side(joint.name).plain);
    if (!found) return "";
    const auto digit = static_cast<std::size_t>(found->digit), number = found->number;
    constexpr std::array<std::string_view, 5> capitals{"Thumb", "Index", "Middle", "Ring", "Little"};
    switch (names) {
    case JointNames::smpl: { // SMPL-H and SMPL-X
        const std::string_view name = found->digit == hands::Digit::little ? "pinky" : hands::name_of(found->digit);
        return with_side(joint.side, "left_", "right_", std::string(name) + std::to_string(number));
    }
    case JointNames::mixamo: {
        const std::string_view name = found->digit == hands::Digit::little ? "Pinky" : capitals[digit];
        return with_side(joint.side, "Left", "Right", "Hand" + std::string(name) + std::to_string(number));
    }
    case JointNames::vrm: {
        constexpr std::array<std::string_view, 3> of_finger{"Proximal", "Intermediate", "Distal"};
        constexpr std::array<std::string_view, 3> of_thumb{"Metacarpal", "Proximal", "Distal"};
        const auto& parts = found->digit == hands::Digit::thumb ? of_thumb : of_finger;
        return with_side(joint.side, "left", "right", std::string(capitals[digit]) + std::string(parts[number - 1]));
    }
    case JointNames::skelgen:
        break;
    }
    return "";
}

} // namespace

std::string name_of(const applications::RigJoint<double>& joint, JointNames names) {
    if (const std::string name = digit_name(joint, names); !name.empty()) return name;
    const RoleNames& role = role_names.at(static_cast<std::size_t>(joint.role));
    switch (names) {
    case JointNames::smpl:
        return with_side(joint.side, "left_", "right_", role.smpl);
    case JointNames::mixamo:
        return with_side(joint.side, "Left", "Right", role.mixamo);
    case JointNames::vrm:
        return with_side(joint.side, "left", "right", role.vrm);
    case JointNames::skelgen:
        break;
    }
    return joint.name;
}

std::optional<JointNames> joint_names_named(std::string_view name) {
    constexpr std::array<std::string_view, 4> all{"skelgen", "smpl", "mixamo", "vrm"};
    const auto* const found = std::find(all.begin(), all.end(), name);
    if (found == all.end()) return std::nullopt;
    return static_cast<JointNames>(found - all.begin());
}

std::vector<std::string> names_of(const std::vector<applications::RigJoint<double>>& joints, JointNames names) {
    std::vector<std::string> out;
    for (const auto& joint : joints) {
        const std::string name = name_of(joint, names);
        // Where there are fingers, the middle of the knuckles is no bone of theirs.
        const bool is_taken = std::find(out.begin(), out.end(), name) != out.end() ||
                              std::any_of(joints.begin(), joints.end(), [&](const auto& other) {
                                  return !digit_name(other, names).empty() && other.name != joint.name &&
                                         digit_name(other, names) == name;
                              });
        out.push_back(is_taken ? joint.name : name);
    }
    return out;
}

} // namespace skelgen::io
