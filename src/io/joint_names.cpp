#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include <skelgen/core/skeleton_template.hpp>
#include <skelgen/hands/digit.hpp>
#include <skelgen/io/rig_formats.hpp>

namespace skelgen::io {
namespace {

/// What a convention calls joints: what is before and behind the names of the left side's and the right side's.
struct Convention {
    std::string_view name;
    std::array<std::string_view, 2> before, behind;
    std::array<std::string_view, 13> roles;                ///< in the order of JointRole; empty: the joint's own
    std::array<std::string_view, 5> digits;                ///< thumb first
    std::array<std::string_view, 3> of_thumb, of_a_finger; ///< behind a digit's name, from the hand to the tip
    /// Of `engine_bones`, and the chest's where there is an upper one; empty: their own.
    std::array<std::string_view, 6> extra;
    std::string_view lower_chest;
};

/// What applications::with_engine_bones adds, without sides.
constexpr std::array<std::string_view, 6> engine_bones{"root",          "upper_chest", "clavicle", "upper_arm_twist",
                                                       "forearm_twist", "thigh_twist"};

/// In the order of JointNames. From: SMPL and SMPL-X, joint_names.py of the smplx package; Mixamo, its skeleton without
/// the prefix of its files; VRM, its specification of humanoids, 1.0; Unity, the enumeration HumanBodyBones; Godot,
/// SkeletonProfileHumanoid of 4.x; Unreal, the skeleton of its mannequin; Rigify, its human meta-rig.
constexpr std::array<Convention, 11> conventions{
    {{"skelgen", {}, {}, {}, {}, {}, {}, {}, {}},
     {"smpl",
      {"left_", "right_"},
      {},
      {"pelvis", "spine1", "spine3", "neck", "head", "shoulder", "elbow", "wrist", "hand", "hip", "knee", "ankle",
       "foot"},
      {"thumb", "index", "middle", "ring", "pinky"}, // SMPL-H
      {"1", "2", "3"},
      {"1", "2", "3"},
      {"", "spine3", "collar", "", "", ""},
      "spine2"},
     {"mixamo",
      {"Left", "Right"},
      {},
      {"Hips", "Spine", "Spine2", "Neck", "Head", "Arm", "ForeArm", "Hand", "HandMiddle1", "UpLeg", "Leg", "Foot",
       "ToeBase"},
      {"HandThumb", "HandIndex", "HandMiddle", "HandRing", "HandPinky"},
      {"1", "2", "3"},
      {"1", "2", "3"},
      {"", "Spine2", "Shoulder", "", "", ""},
      "Spine1"},
     {"vrm",
      {"left", "right"},
      {},
      {"hips", "spine", "chest", "neck", "head", "UpperArm", "LowerArm", "Hand", "MiddleProximal", "UpperLeg",
       "LowerLeg", "Foot", "Toes"},
      {"Thumb", "Index", "Middle", "Ring", "Little"},
      {"Metacarpal", "Proximal", "Distal"},
      {"Proximal", "Intermediate", "Distal"},
      {"", "upperChest", "Shoulder", "", "", ""},
      "chest"},
     {"smplx",
      {"left_", "right_"},
      {},
      {"pelvis", "spine1", "spine3", "neck", "head", "shoulder", "elbow", "wrist", "middle1", "hip", "knee", "ankle",
       "foot"},
      {"thumb", "index", "middle", "ring", "pinky"},
      {"1", "2", "3"},
      {"1", "2", "3"},
      {"", "spine3", "collar", "", "", ""},
      "spine2"},
     {"unity",
      {"Left", "Right"},
      {},
      {"Hips", "Spine", "Chest", "Neck", "Head", "UpperArm", "LowerArm", "Hand", "MiddleProximal", "UpperLeg",
       "LowerLeg", "Foot", "Toes"},
      {"Thumb", "Index", "Middle", "Ring", "Little"},
      {"Proximal", "Intermediate", "Distal"}, // of the same bones that VRM names by what they are
      {"Proximal", "Intermediate", "Distal"},
      {"", "UpperChest", "Shoulder", "", "", ""},
      "Chest"},
     {"godot",
      {"Left", "Right"},
      {},
      {"Hips", "Spine", "Chest", "Neck", "Head", "UpperArm", "LowerArm", "Hand", "MiddleProximal", "UpperLeg",
       "LowerLeg", "Foot", "Toes"},
      {"Thumb", "Index", "Middle", "Ring", "Little"},
      {"Metacarpal", "Proximal", "Distal"},
      {"Proximal", "Intermediate", "Distal"},
      {"Root", "UpperChest", "Shoulder", "", "", ""},
      "Chest"},
     {"unreal",
      {},
      {"_l", "_r"},
      {"pelvis", "spine_01", "spine_03", "neck_01", "head", "upperarm", "lowerarm", "hand", "middle_01", "thigh",
       "calf", "foot", "ball"},
      {"thumb", "index", "middle", "ring", "pinky"},
      {"_01", "_02", "_03"},
      {"_01", "_02", "_03"},
      {"root", "spine_03", "clavicle", "upperarm_twist_01", "lowerarm_twist_01", "thigh_twist_01"},
      "spine_02"},
     {"rigify",
      {},
      {".L", ".R"},
      {"spine", "spine.001", "spine.003", "spine.004", "spine.006", "upper_arm", "forearm", "hand", "f_middle.01",
       "thigh", "shin", "foot", "toe"},
      {"thumb", "f_index", "f_middle", "f_ring", "f_pinky"},
      {".01", ".02", ".03"},
      {".01", ".02", ".03"},
      {"root", "spine.003", "shoulder", "", "", ""},
      "spine.002"},
     {"mesh2motion-fox", {}, {}, {}, {}, {}, {}, {}, {}}, // of animals, below
     {"mesh2motion-horse", {}, {}, {}, {}, {}, {}, {}, {}}}};

/// What a convention calls an animal's joints; those of sides with what is behind the names of the left and the right.
struct AnimalConvention {
    JointNames names;
    std::array<std::string_view, 2> behind;
    std::array<std::array<std::string_view, 2>, 22> joints; ///< skelgen's, without their side, and its own
};

/// From the rigs of Mesh2Motion's fox and horse.
constexpr std::array<AnimalConvention, 2> animal_conventions{{{JointNames::mesh2motion_fox,
                                                               {"_L", "_R"},
                                                               {{{"hips", "Hips"},
                                                                 {"spine1", "Spine_1"},
                                                                 {"spine2", "Spine_2"},
                                                                 {"chest", "Spine_2.001"},
                                                                 {"neck1", "Spine_3"},
                                                                 {"neck2", "Spine_4"},
                                                                 {"head", "Head"},
                                                                 {"tail1", "Tail_Base"},
                                                                 {"tail2", "Tail_Mid"},
                                                                 {"tail3", "Tail_Mid.001"},
                                                                 {"tail4", "Tail_End"},
                                                                 {"ear", "Ear"},
                                                                 {"fore_girdle", "Front_Leg_Shoulder"},
                                                                 {"fore_upper", "Front_Leg_Upper"},
                                                                 {"fore_lower", "Front_Leg_Lower"},
                                                                 {"fore_ankle", "Front_Leg_Ankle"},
                                                                 {"fore_foot", "Front_Leg_Foot"},
                                                                 {"hind_girdle", "Back_Leg_Pelvis"},
                                                                 {"hind_upper", "Back_Leg_Upper"},
                                                                 {"hind_lower", "Back_Leg_Lower"},
                                                                 {"hind_ankle", "Back_Leg_Ankle"},
                                                                 {"hind_foot", "Back_Leg_Foot_1"}}}},
                                                              {JointNames::mesh2motion_horse,
                                                               {"_l", "_r"},
                                                               {{{"hips", "hips"},
                                                                 {"spine1", "spine_1"},
                                                                 {"spine2", "spine_3"},
                                                                 {"chest", "spine_4"},
                                                                 {"neck1", "spine_5"},
                                                                 {"neck2", "spine_6"},
                                                                 {"head", "head"},
                                                                 {"tail1", "tail_1"},
                                                                 {"tail2", "tail_2"},
                                                                 {"tail3", "tail_3"},
                                                                 {"tail4", "tail_4"},
                                                                 {"ear", "ear_1"},
                                                                 {"fore_girdle", "front_scapula"},
                                                                 {"fore_upper", "front_humerus"},
                                                                 {"fore_lower", "front_leg_upper"},
                                                                 {"fore_ankle", "front_leg_lower"},
                                                                 {"fore_foot", "front_leg_foot"},
                                                                 {"hind_girdle", "back_leg_pelvis"},
                                                                 {"hind_upper", "back_leg_upper"},
                                                                 {"hind_lower", "back_leg_lower"},
                                                                 {"hind_ankle", "back_leg_ankle"},
                                                                 {"hind_foot", "back_leg_toe"}}}}}};

const Convention& convention_of(JointNames names) { return conventions.at(static_cast<std::size_t>(names)); }

std::string with_side(const Convention& convention, Side side, std::string_view name) {
    if (side == Side::none) return std::string(name);
    const std::size_t which = side == Side::left ? 0 : 1;
    return std::string(convention.before[which]).append(name).append(convention.behind[which]);
}

/// What an animal's convention calls a joint; empty where the names are no animal's, or have none for it.
std::string animal_name(const applications::RigJoint<double>& joint, JointNames names) {
    for (const AnimalConvention& convention : animal_conventions)
        for (const auto& [own, name] : convention.joints)
            if (convention.names == names && split_side(joint.name).plain == own)
                return std::string(name).append(
                    joint.side == Side::none ? "" : convention.behind[joint.side == Side::left ? 0 : 1]);
    return "";
}

/// What conventions call a digit's joint; empty for another one, and where they are skelgen's own.
std::string digit_name(const applications::RigJoint<double>& joint, JointNames names) {
    const Convention& convention = convention_of(names);
    const auto found = hands::digit_joint(split_side(joint.name).plain);
    if (!found || convention.digits.front().empty()) return "";
    const auto& parts = found->digit == hands::Digit::thumb ? convention.of_thumb : convention.of_a_finger;
    std::string name(convention.digits.at(static_cast<std::size_t>(found->digit)));
    return with_side(convention, joint.side, name.append(parts.at(found->number - 1)));
}

/// Which of `engine_bones` a joint is; none for another one.
std::optional<std::size_t> engine_bone(const applications::RigJoint<double>& joint) {
    const auto* const found = std::find(engine_bones.begin(), engine_bones.end(), split_side(joint.name).plain);
    if (found == engine_bones.end()) return std::nullopt;
    return static_cast<std::size_t>(found - engine_bones.begin());
}

} // namespace

std::string name_of(const applications::RigJoint<double>& joint, JointNames names) {
    if (std::string name = animal_name(joint, names); !name.empty()) return name;
    if (const auto bone = engine_bone(joint)) {
        const std::string_view name = convention_of(names).extra.at(*bone);
        return name.empty() ? joint.name : with_side(convention_of(names), joint.side, name);
    }
    if (const std::string name = digit_name(joint, names); !name.empty()) return name;
    const auto index = static_cast<std::size_t>(joint.role);
    const auto& roles = convention_of(names).roles;
    const std::string_view role = index < roles.size() ? roles[index] : ""; // what people have none of
    return role.empty() ? joint.name : with_side(convention_of(names), joint.side, role);
}

std::optional<JointNames> joint_names_named(std::string_view name) {
    const auto* const found = std::find_if(conventions.begin(), conventions.end(),
                                           [&](const Convention& convention) { return convention.name == name; });
    if (found == conventions.end()) return std::nullopt;
    return static_cast<JointNames>(found - conventions.begin());
}

std::vector<std::string> joint_names() {
    std::vector<std::string> out;
    for (const Convention& convention : conventions) out.emplace_back(convention.name);
    return out;
}

std::vector<std::string> names_of(const std::vector<applications::RigJoint<double>>& joints, JointNames names) {
    std::vector<std::string> out;
    const std::string_view lower_chest = convention_of(names).lower_chest;
    const bool has_two_chests =
        !lower_chest.empty() &&
        std::any_of(joints.begin(), joints.end(), [](const auto& joint) { return joint.name == "upper_chest"; });
    for (const auto& joint : joints) {
        const bool is_lower = has_two_chests && joint.role == JointRole::chest && !engine_bone(joint);
        const std::string name = is_lower ? std::string(lower_chest) : name_of(joint, names);
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
