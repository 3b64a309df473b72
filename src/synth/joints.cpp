#include <string>

#include <skelgen/synth/pose.hpp>

namespace skelgen::synth {
namespace {

constexpr std::array<std::string_view, body_joint_count> names{
    "crotch",     "waist",      "chest",          "neck",        "head",        "left_shoulder", "left_elbow",
    "left_wrist", "left_hand",  "right_shoulder", "right_elbow", "right_wrist", "right_hand",    "left_hip",
    "left_knee",  "left_ankle", "left_foot",      "right_hip",   "right_knee",  "right_ankle",   "right_foot"};

constexpr std::array<int, body_joint_count> parents{0,  0,  1, 2,  3,  2,  5, 6,  7,  2, 9,
                                                    10, 11, 0, 13, 14, 15, 0, 17, 18, 19};

} // namespace

std::string_view joint_name(BodyJoint joint) { return names[static_cast<std::size_t>(joint)]; }

BodyJoint joint_parent(BodyJoint joint) { return static_cast<BodyJoint>(parents[static_cast<std::size_t>(joint)]); }

BodyJoint mirrored_joint(BodyJoint joint) {
    const int j = static_cast<int>(joint), left_arm = static_cast<int>(BodyJoint::left_shoulder),
              right_arm = static_cast<int>(BodyJoint::right_shoulder), left_leg = static_cast<int>(BodyJoint::left_hip),
              right_leg = static_cast<int>(BodyJoint::right_hip);
    if (j < left_arm) return joint;
    if (j < right_arm) return static_cast<BodyJoint>(j + 4);
    if (j < left_leg) return static_cast<BodyJoint>(j - 4);
    if (j < right_leg) return static_cast<BodyJoint>(j + 4);
    return static_cast<BodyJoint>(j - 4);
}

} // namespace skelgen::synth
