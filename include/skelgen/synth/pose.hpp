#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace skelgen::synth {

/// The joints of `human21` in its order: parents before children.
enum class BodyJoint {
    crotch,
    waist,
    chest,
    neck,
    head,
    left_shoulder,
    left_elbow,
    left_wrist,
    left_hand,
    right_shoulder,
    right_elbow,
    right_wrist,
    right_hand,
    left_hip,
    left_knee,
    left_ankle,
    left_foot,
    right_hip,
    right_knee,
    right_ankle,
    right_foot
};

inline constexpr int body_joint_count = 21;

/// `human21`'s name of a joint.
[[nodiscard]] std::string_view joint_name(BodyJoint joint);

/// Its parent; the root (crotch) is its own.
[[nodiscard]] BodyJoint joint_parent(BodyJoint joint);

/// The joint on the other side of the body; joints in the middle are their own.
[[nodiscard]] BodyJoint mirrored_joint(BodyJoint joint);

/// The rotation at a joint in degrees, from standing straight with the arms hanging and the thumbs in front. The same
/// numbers on the left and on the right are mirror images.
struct JointAngles {
    double bend = 0; ///< spine, shoulder, elbow, hip: forwards; knee: heel to buttock; wrist: towards the palm;
                     ///< ankle, foot: toes up; hand: fingers into the palm
    double side = 0; ///< spine: to the left; limbs: away from the body; wrist: towards the thumb; hand: fingers spread
    double turn = 0; ///< about the bone: spine to the left; limbs outwards; wrist: of the forearm, palm to the front
};

struct AngleRange {
    JointAngles low;
    JointAngles high;
};

/// Where a joint's angles stop in a living human (the root's are free).
[[nodiscard]] AngleRange joint_limits(BodyJoint joint);

/// How a body holds itself; all zero: standing straight, arms hanging.
struct BodyPose {
    std::array<JointAngles, body_joint_count> angles{};

    [[nodiscard]] JointAngles& at(BodyJoint joint) { return angles[static_cast<std::size_t>(joint)]; }
    [[nodiscard]] const JointAngles& at(BodyJoint joint) const { return angles[static_cast<std::size_t>(joint)]; }
};

/// \throws Error usage naming the joint, the angle and its range.
void check_pose(const BodyPose& pose);

/// The pose seen in a mirror.
[[nodiscard]] BodyPose mirrored(const BodyPose& pose);

/// The named poses in alphabetical order.
[[nodiscard]] std::vector<std::string> pose_names();

/// \throws Error usage naming the known poses.
[[nodiscard]] BodyPose named_pose(std::string_view name);

/// A pose within the limits drawn from `seed`: the same on every machine. It may sink limbs into each other
/// (`synthesize_body` in body.hpp rejects those).
[[nodiscard]] BodyPose random_pose(std::uint64_t seed);

/// A pose from JSON: {"left_elbow": [bend, side, turn], ...} in degrees, joints left out at rest; "pose": NAME starts
/// from a named one.
/// \throws Error bad_input when it is no such JSON, usage as `check_pose`.
[[nodiscard]] BodyPose parse_pose(std::string_view json);

} // namespace skelgen::synth
