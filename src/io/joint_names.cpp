#include <algorithm>
#include <array>
#include <string>
#include <string_view>

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

} // namespace

std::string name_of(const applications::RigJoint<double>& joint, JointNames names) {
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
        const bool is_taken = std::find(out.begin(), out.end(), name) != out.end();
        out.push_back(is_taken ? joint.name : name);
    }
    return out;
}

} // namespace skelgen::io
