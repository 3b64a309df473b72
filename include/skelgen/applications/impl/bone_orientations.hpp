#pragma once

#include <skelgen/applications/bone_orientations.hpp>

#include <cmath>
#include <cstddef>

#include <skelgen/applications/bones.hpp>
#include <skelgen/applications/canonical_frame.hpp>
#include <skelgen/core/precision.hpp>

namespace skelgen::applications {
namespace detail {

/// Directions of a skeleton's bones, by the template's joints: zero where there is none.
template <typename Scalar>
struct BoneDirections {
    const KinematicSkeleton<Scalar>& skeleton;
    const SkeletonTemplate& skeleton_template;

    [[nodiscard]] Vector3<Scalar> of(int joint) const {
        if (joint < 0) return Vector3<Scalar>::Zero();
        const Vector3<Scalar> from = skeleton.joints[static_cast<std::size_t>(joint)].position;
        return (bone_end(skeleton, skeleton_template, joint) - from).stableNormalized();
    }
    [[nodiscard]] Vector3<Scalar> of(JointRole role, Side side) const {
        return of(find_joint(skeleton_template, role, side));
    }
    /// From the right one of a pair of joints to the left one.
    [[nodiscard]] Vector3<Scalar> between(JointRole role) const {
        const int left = find_joint(skeleton_template, role, Side::left);
        const int right = find_joint(skeleton_template, role, Side::right);
        if (left < 0 || right < 0) return Vector3<Scalar>::Zero();
        return (skeleton.joints[static_cast<std::size_t>(left)].position -
                skeleton.joints[static_cast<std::size_t>(right)].position)
            .stableNormalized();
    }
};

/// The axis that lifts the foot; zero where foot and calf lie in one line.
template <typename Scalar>
Vector3<Scalar> foot_axis(const BoneDirections<Scalar>& bones, Side side) {
    return bones.of(JointRole::ankle, side).cross(bones.of(JointRole::knee, side));
}

/// The axis that a joint's bone bends about in the rest pose: an arm's swings the hand forwards, all others but the
/// foot's are the body's own left.
template <typename Scalar>
Vector3<Scalar> rest_bending_axis(const BoneDirections<Scalar>& rest, int j) {
    const TemplateJoint& joint = rest.skeleton_template.joint(j);
    if (part_of(joint.role) == BodyPart::arm) return rest.of(j).cross(Vector3<Scalar>::UnitZ());
    const Vector3<Scalar> left = Vector3<Scalar>::UnitX();
    if (joint.role != JointRole::ankle) return left;
    const Vector3<Scalar> axis = foot_axis(rest, joint.side);
    return axis.isZero(0) ? left : axis;
}

/// How far the foot points outwards in the rest pose: the turn about the calf from the axis that a knee bends about to
/// that which lifts the foot.
template <typename Scalar>
Scalar rest_toe_out(const BoneDirections<Scalar>& rest, Side side) {
    const Vector3<Scalar> axis = foot_axis(rest, side), left = Vector3<Scalar>::UnitX();
    return std::atan2(left.cross(axis).dot(rest.of(JointRole::knee, side)), left.dot(axis));
}

/// What is seen of the axis that a bone bends about: longer where it is clearer, zero where nothing is. The bend of an
/// elbow or a knee shows it by its sine. A foot stands off the calf whatever the pose, but the ankle may turn it.
/// `toe_out`: of the rest pose.
template <typename Scalar>
Vector3<Scalar> seen_bending_axis(const BoneDirections<Scalar>& bones, const TemplateJoint& joint, Scalar toe_out) {
    const auto seen_in_leg = [&](Scalar weight_of_foot) -> Vector3<Scalar> {
        const Vector3<Scalar> calf = bones.of(JointRole::knee, joint.side);
        const Eigen::AngleAxis<Scalar> back(-toe_out, calf);
        return bones.of(JointRole::hip, joint.side).cross(calf) +
               weight_of_foot * (back * foot_axis(bones, joint.side));
    };
    switch (joint.role) {
    case JointRole::pelvis:
        return bones.between(JointRole::hip);
    case JointRole::waist:
        return bones.between(JointRole::hip) + bones.between(JointRole::shoulder);
    case JointRole::chest:
        return bones.between(JointRole::shoulder);
    case JointRole::shoulder:
    case JointRole::elbow:
        return bones.of(JointRole::shoulder, joint.side).cross(bones.of(JointRole::elbow, joint.side));
    case JointRole::hip:
        return seen_in_leg(Scalar(0.3));
    case JointRole::knee:
        return seen_in_leg(Scalar(1));
    case JointRole::ankle:
        return foot_axis(bones, joint.side);
    default:
        return Vector3<Scalar>::Zero();
    }
}

/// How much the least turn from the parent counts beside what is seen: as a bend by 12 degrees.
template <typename Scalar>
inline constexpr Scalar weight_of_least_turn = Scalar(0.2);

} // namespace detail

template <typename Scalar>
Orientations<Scalar> rest_axes(const SkeletonTemplate& skeleton_template) {
    const KinematicSkeleton<Scalar> rest = rest_skeleton<Scalar>(skeleton_template);
    const detail::BoneDirections<Scalar> bones{rest, skeleton_template};
    Orientations<Scalar> out;
    for (std::size_t j = 0; j < skeleton_template.joints.size(); ++j) {
        const TemplateJoint& joint = skeleton_template.joints[j];
        const Vector3<Scalar> direction = bones.of(static_cast<int>(j));
        if (direction.isZero(0)) // a limb's end without a tip: as the bone that leads to it
            out.push_back(out[static_cast<std::size_t>(joint.parent)]);
        else
            out.push_back(axes_along(direction, detail::rest_bending_axis(bones, static_cast<int>(j))));
    }
    return out;
}

template <typename Scalar>
Orientations<Scalar> bone_orientations(const KinematicSkeleton<Scalar>& skeleton,
                                       const SkeletonTemplate& skeleton_template) {
    using Rotation = Eigen::Quaternion<Scalar>;
    const Orientations<Scalar> axes = rest_axes<Scalar>(skeleton_template);
    const KinematicSkeleton<Scalar> rest = rest_skeleton<Scalar>(skeleton_template);
    const detail::BoneDirections<Scalar> bones{skeleton, skeleton_template}, rest_bones{rest, skeleton_template};
    const BodyFrame<Scalar>& frame = skeleton.frame;
    Orientations<Scalar> out;
    for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
        const TemplateJoint& joint = skeleton_template.joints[j];
        const Rotation from_parent =
            joint.parent >= 0 ? out[static_cast<std::size_t>(joint.parent)] : axes_along(frame.up, frame.left);
        const Vector3<Scalar> direction = bones.of(static_cast<int>(j));
        if (direction.isZero(0)) {
            out.push_back(from_parent);
            continue;
        }
        const Rotation carried = from_parent * axes[j];
        const Rotation least_turn = Rotation::FromTwoVectors(carried * Vector3<Scalar>::UnitY(), direction) * carried;
        const Vector3<Scalar> seen =
            detail::seen_bending_axis(bones, joint, detail::rest_toe_out(rest_bones, joint.side));
        const Vector3<Scalar> across = (seen - seen.dot(direction) * direction) +
                                       detail::weight_of_least_turn<Scalar> * (least_turn * Vector3<Scalar>::UnitX());
        const bool is_clear = across.norm() > core::rounding<Scalar>();
        const Rotation now = is_clear ? axes_along<Scalar>(direction, across) : least_turn;
        out.push_back((now * axes[j].conjugate()).normalized());
    }
    return out;
}

} // namespace skelgen::applications
