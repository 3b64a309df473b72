#pragma once

#include <array>

#include <Eigen/Geometry>

#include <skelgen/synth/pose.hpp>

#include "proportions.hpp"

namespace skelgen::synth {

/// Where the joints are and how what hangs on them is turned. In the rest pose every frame is parallel to the world's
/// axes: x to the person's left, y backwards, z up (a right-handed triple).
struct PosedSkeleton {
    std::array<Eigen::Vector3d, body_joint_count> rest;
    std::array<Eigen::Isometry3d, body_joint_count> frames; ///< joint to world: rotation of what follows the joint

    [[nodiscard]] const Eigen::Isometry3d& frame(BodyJoint joint) const {
        return frames[static_cast<std::size_t>(joint)];
    }
    [[nodiscard]] Eigen::Vector3d position(BodyJoint joint) const { return frame(joint).translation(); }
    [[nodiscard]] const Eigen::Vector3d& rest_position(BodyJoint joint) const {
        return rest[static_cast<std::size_t>(joint)];
    }
};

/// The joint `steps` further down the limb, 3 at most.
[[nodiscard]] constexpr BodyJoint next(BodyJoint joint, int steps) {
    return static_cast<BodyJoint>(static_cast<int>(joint) + steps);
}

/// +1 on the left, -1 on the right, 0 in the middle.
[[nodiscard]] int side_of(BodyJoint joint);

/// The point about which the skull is modelled, at the height of the nose and behind the middle of the head, from the
/// head joint. The joint itself is where SMPL's regressor finds it, at the height of the mouth. Calibrated: upright
/// people of FAUST have it 0.027 of their height above the neck joint, 0.037 in front of it and 0.028 below the tip of
/// the nose.
[[nodiscard]] Eigen::Vector3d skull_origin(const Proportions& proportions);

/// Forward kinematics: bones keep their lengths in every pose (raised arms lift the shoulders about the chest).
[[nodiscard]] PosedSkeleton pose_skeleton(const Proportions& proportions, const BodyPose& pose);

/// The local rotation at a joint.
[[nodiscard]] Eigen::Matrix3d joint_rotation(BodyJoint joint, const JointAngles& angles);

} // namespace skelgen::synth
