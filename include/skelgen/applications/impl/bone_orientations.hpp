#pragma once

#include <skelgen/applications/bone_orientations.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <skelgen/applications/canonical_frame.hpp>
#include <skelgen/applications/impl/bones.hpp>
#include <skelgen/core/error.hpp>
#include <skelgen/core/precision.hpp>
#include <skelgen/core/shortest_turn.hpp>

namespace skelgen::applications {
namespace detail {

/// Directions of a skeleton's bones, by the template's joints: zero where there is none.
template <typename Scalar>
struct BoneDirections {
    const KinematicSkeleton<Scalar>& skeleton;
    const SkeletonTemplate& skeleton_template;

    [[nodiscard]] Vector3<Scalar> of(int joint) const {
        if (joint < 0) return Vector3<Scalar>::Zero();
        return (bone_end(skeleton, skeleton_template, joint) - place(joint)).stableNormalized();
    }
    [[nodiscard]] Vector3<Scalar> of(JointRole role, Side side) const {
        return of(find_joint(skeleton_template, role, side));
    }
    /// The direction that tells how a joint is turned: its bone's, but for pelvis and neck, whose bones are short and
    /// end deep inside, that of a longer line which turns with it: from between the hips to the waist, from the neck to
    /// the top of the head. What a joint is found off turns that far less.
    [[nodiscard]] Vector3<Scalar> turned_with(int joint) const {
        switch (skeleton_template.joint(joint).role) {
        case JointRole::pelvis:
            return (bone_end(skeleton, skeleton_template, joint) - between_hips()).stableNormalized();
        case JointRole::neck: {
            const int head = find_joint(skeleton_template, JointRole::head, Side::none);
            return (bone_end(skeleton, skeleton_template, head) - place(joint)).stableNormalized();
        }
        default:
            return of(joint);
        }
    }
    /// From the right one of a pair of joints to the left one.
    [[nodiscard]] Vector3<Scalar> between(JointRole role) const {
        const int left = find_joint(skeleton_template, role, Side::left);
        const int right = find_joint(skeleton_template, role, Side::right);
        if (left < 0 || right < 0) return Vector3<Scalar>::Zero();
        return (place(left) - place(right)).stableNormalized();
    }

private:
    [[nodiscard]] const Vector3<Scalar>& place(int joint) const {
        return skeleton.joints[static_cast<std::size_t>(joint)].position;
    }
    [[nodiscard]] Vector3<Scalar> between_hips() const {
        return (place(find_joint(skeleton_template, JointRole::hip, Side::left)) +
                place(find_joint(skeleton_template, JointRole::hip, Side::right))) /
               2;
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

/// Axes in the rest pose: y along the lines that `line` has for the joints, x about which they bend.
template <typename Scalar, typename Line>
Orientations<Scalar> rest_axes_along(const BoneDirections<Scalar>& rest, const Line& line) {
    Orientations<Scalar> out;
    for (std::size_t j = 0; j < rest.skeleton_template.joints.size(); ++j) {
        const Vector3<Scalar> direction = line(static_cast<int>(j));
        if (direction.isZero(0)) // a limb's end without a tip: as the bone that leads to it
            out.push_back(out[static_cast<std::size_t>(rest.skeleton_template.joints[j].parent)]);
        else
            out.push_back(axes_along(direction, rest_bending_axis(rest, static_cast<int>(j))));
    }
    return out;
}

/// The template's rest pose with those end points alone that a skeleton has, too.
template <typename Scalar>
KinematicSkeleton<Scalar> rest_with_ends_of(const KinematicSkeleton<Scalar>& skeleton,
                                            const SkeletonTemplate& skeleton_template) {
    KinematicSkeleton<Scalar> rest = rest_skeleton<Scalar>(skeleton_template);
    std::erase_if(rest.end_points, [&](const auto& end) {
        return std::none_of(skeleton.end_points.begin(), skeleton.end_points.end(),
                            [&](const auto& known) { return known.first == end.first; });
    });
    return rest;
}

/// How much the least turn from the parent counts beside what is seen: as a bend by 12 degrees.
template <typename Scalar>
inline constexpr Scalar weight_of_least_turn = Scalar(0.2);

} // namespace detail

template <typename Scalar>
Orientations<Scalar> rest_axes(const SkeletonTemplate& skeleton_template) {
    const KinematicSkeleton<Scalar> rest = rest_skeleton<Scalar>(skeleton_template);
    const detail::BoneDirections<Scalar> bones{rest, skeleton_template};
    return detail::rest_axes_along(bones, [&](int j) { return bones.of(j); });
}

template <typename Scalar>
Orientations<Scalar> bone_orientations(const KinematicSkeleton<Scalar>& skeleton,
                                       const SkeletonTemplate& skeleton_template) {
    using Rotation = Eigen::Quaternion<Scalar>;
    const KinematicSkeleton<Scalar> rest = detail::rest_with_ends_of(skeleton, skeleton_template);
    const detail::BoneDirections<Scalar> bones{skeleton, skeleton_template}, rest_bones{rest, skeleton_template};
    const Orientations<Scalar> axes =
        detail::rest_axes_along(rest_bones, [&](int j) { return rest_bones.turned_with(j); });
    const BodyFrame<Scalar>& frame = skeleton.frame;
    Orientations<Scalar> out;
    for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
        const TemplateJoint& joint = skeleton_template.joints[j];
        const Rotation from_parent =
            joint.parent >= 0 ? out[static_cast<std::size_t>(joint.parent)] : axes_along(frame.up, frame.left);
        const Vector3<Scalar> direction = bones.turned_with(static_cast<int>(j));
        if (direction.isZero(0)) {
            out.push_back(from_parent);
            continue;
        }
        const Rotation carried = from_parent * axes[j];
        const Rotation least_turn =
            core::shortest_turn<Scalar>(carried * Vector3<Scalar>::UnitY(), direction) * carried;
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

template <typename Scalar>
Orientations<Scalar> bone_axes(const KinematicSkeleton<Scalar>& skeleton, const SkeletonTemplate& skeleton_template,
                               const Orientations<Scalar>& orientations) {
    if (orientations.size() != skeleton.joints.size())
        throw Error(ErrorCode::usage, "a pose must have as many orientations as the skeleton has joints");
    const Orientations<Scalar> rest = rest_axes<Scalar>(skeleton_template);
    const detail::BoneDirections<Scalar> bones{skeleton, skeleton_template};
    Orientations<Scalar> out;
    for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
        const Eigen::Quaternion<Scalar> turned = (orientations[j] * rest[j]).normalized();
        const Vector3<Scalar> bone = bones.of(static_cast<int>(j));
        const bool has_bone = !bone.isZero(0);
        out.push_back(has_bone
                          ? (core::shortest_turn<Scalar>(turned * Vector3<Scalar>::UnitY(), bone) * turned).normalized()
                          : turned);
    }
    return out;
}

} // namespace skelgen::applications
