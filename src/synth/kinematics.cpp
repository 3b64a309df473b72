#include "kinematics.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace skelgen::synth {
namespace {

using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double degree = std::numbers::pi / 180;

Vector3d towards(double side, double back, double up) { return {side, back, up}; }

std::array<Vector3d, body_joint_count> rest_positions(const Proportions& p) {
    std::array<Vector3d, body_joint_count> rest;
    const auto set = [&rest](BodyJoint joint, const Vector3d& offset) {
        rest[static_cast<std::size_t>(joint)] = rest[static_cast<std::size_t>(joint_parent(joint))] + offset;
    };
    const double s = p.scale;
    const double root = p.ankle_height + p.calf + p.thigh + p.hip_drop;
    rest[0] = towards(0, -0.008 * s, root);
    const double waist_forward =
        (0.003 + 0.042 * std::max(0.0, p.fat)) * s; // to the middle of its section, belly and all
    set(BodyJoint::waist, towards(0, -waist_forward, p.lower_spine));
    set(BodyJoint::chest, towards(0, waist_forward - 0.006 * s, p.upper_spine));
    set(BodyJoint::neck, towards(0, 0.014 * s, p.neck_base));
    set(BodyJoint::head, towards(0, -0.044 * s - skull_origin(p).y(), p.neck));
    const auto limbs = [&](int side, BodyJoint shoulder, BodyJoint hip) {
        set(shoulder, towards(side * p.shoulder_half_width, 0.024 * s, p.shoulder_rise));
        set(next(shoulder, 1), towards(0, 0, -p.upper_arm));
        set(next(shoulder, 2), towards(0, 0, -p.forearm));
        set(next(shoulder, 3), towards(0, 0, -p.palm));
        set(hip, towards(side * p.hip_half_width, 0.006 * s, -p.hip_drop));
        set(next(hip, 1), towards(0, 0, -p.thigh));
        set(next(hip, 2), towards(0, 0, -p.calf));
        set(next(hip, 3), towards(0, -0.119 * p.foot_scale, -p.ankle_height + 0.020 * p.foot_scale));
    };
    limbs(1, BodyJoint::left_shoulder, BodyJoint::left_hip);
    limbs(-1, BodyJoint::right_shoulder, BodyJoint::right_hip);
    return rest;
}

/// The rotation that swings by `bend` about `bend_axis` and `side` about `side_axis` at once, after a turn about z.
Matrix3d swing(const Vector3d& bend_axis, const Vector3d& side_axis, double turn_sign, const JointAngles& a) {
    const Vector3d rotation = degree * (a.bend * bend_axis + a.side * side_axis);
    const double angle = rotation.norm();
    const Matrix3d twist = AngleAxisd(degree * turn_sign * a.turn, Vector3d::UnitZ()).toRotationMatrix();
    if (angle < 1e-12) return twist;
    return AngleAxisd(angle, rotation / angle).toRotationMatrix() * twist;
}

bool is_shoulder(BodyJoint joint) { return joint == BodyJoint::left_shoulder || joint == BodyJoint::right_shoulder; }

/// How the shoulder blade carries the shoulder joint when the arm leaves the side of the body: up and inwards for a
/// raised arm, forwards for one before the chest. Rates as in registered scans of people.
Vector3d carried_shoulder(const Vector3d& offset, int side, const Matrix3d& arm) {
    const Vector3d direction = arm * -Vector3d::UnitZ();
    const double raised = std::acos(std::clamp(-direction.z(), -1.0, 1.0)) / degree;
    const double lift = 0.16 * raised * degree;
    const double forward = 20 * degree * std::max(0.0, -direction.y());
    return AngleAxisd(-side * forward, Vector3d::UnitZ()) * (AngleAxisd(-side * lift, Vector3d::UnitY()) * offset);
}

} // namespace

Vector3d skull_origin(const Proportions& p) { return p.head_scale * towards(0, 0.021, 0.051); }

int side_of(BodyJoint joint) {
    const std::string_view name = joint_name(joint);
    return name.starts_with("left") ? 1 : name.starts_with("right") ? -1 : 0;
}

Matrix3d joint_rotation(BodyJoint joint, const JointAngles& angles) {
    const Vector3d x = Vector3d::UnitX(), y = Vector3d::UnitY();
    const double side = side_of(joint);
    switch (joint) {
    case BodyJoint::crotch:
    case BodyJoint::waist:
    case BodyJoint::chest:
    case BodyJoint::neck:
    case BodyJoint::head:
        return swing(x, y, 1, angles);
    case BodyJoint::left_wrist:
    case BodyJoint::right_wrist: // the forearm turns the wrist's own axes with it
        return AngleAxisd(degree * side * angles.turn, Vector3d::UnitZ()) *
               swing(side * y, -x, side, {angles.bend, angles.side, 0});
    case BodyJoint::left_knee:
    case BodyJoint::right_knee:
        return swing(x, -side * y, side, angles);
    case BodyJoint::left_hand:
    case BodyJoint::right_hand:
        return Matrix3d::Identity(); // the fingers' business, not the skeleton's
    default:
        return swing(-x, -side * y, side, angles);
    }
}

PosedSkeleton pose_skeleton(const Proportions& proportions, const BodyPose& pose) {
    PosedSkeleton skeleton;
    skeleton.rest = rest_positions(proportions);
    for (int j = 0; j < body_joint_count; ++j) {
        const auto joint = static_cast<BodyJoint>(j);
        const auto index = static_cast<std::size_t>(j), parent = static_cast<std::size_t>(joint_parent(joint));
        const Matrix3d local = joint_rotation(joint, pose.angles[index]);
        Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
        if (j == 0) {
            frame.linear() = local;
            frame.translation() = skeleton.rest[0];
        } else {
            Vector3d offset = skeleton.rest[index] - skeleton.rest[parent];
            if (is_shoulder(joint)) offset = carried_shoulder(offset, side_of(joint), local);
            frame.linear() = skeleton.frames[parent].linear() * local;
            frame.translation() = skeleton.frames[parent] * offset;
        }
        skeleton.frames[index] = frame;
    }
    return skeleton;
}

} // namespace skelgen::synth
