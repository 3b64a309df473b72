#pragma once

#include <vector>

#include <Eigen/Geometry>

#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/core/skeleton_template.hpp>

namespace skelgen::applications {

/// One rotation per joint.
template <typename Scalar>
using Orientations = std::vector<Eigen::Quaternion<Scalar>>;

/// Axes of each joint in the template's rest pose, as a rotation from x, y and z to them: y along the joint's bone; x
/// about which it bends (elbows and knees by positive angles). Axes of the right side are those of the left one
/// mirrored, so that equal rotations about x, and opposite ones about y and z, move both sides alike. O(joints^2).
template <typename Scalar>
[[nodiscard]] Orientations<Scalar> rest_axes(const SkeletonTemplate& skeleton_template);

/// The pose of a body: for each joint the rotation that turns its bone, and all that is fixed to it, from the
/// template's rest pose (x to the left, y up, z forward) to where it is, in the skeleton's coordinates. Joints are
/// turned as their bones; pelvis and neck, whose bones are short and end deep inside, as longer lines that turn with
/// them: from between the hips to the waist, from the neck to the top of the head. How a bone is turned about
/// itself is seen in what it carries: the trunk's in the lines of hips and shoulders, a limb's in the plane in which
/// elbow or knee bends and in where the foot points; where that says nothing, as for a straight arm, the bone has
/// turned from its parent by the least that leads to its direction. A bone without length turns with its parent.
/// O(joints^2). \throws Error usage when the skeleton's joints are not the template's.
template <typename Scalar>
[[nodiscard]] Orientations<Scalar> bone_orientations(const KinematicSkeleton<Scalar>& skeleton,
                                                     const SkeletonTemplate& skeleton_template);

/// Axes of each joint where it is: those of the rest pose turned by the joint's `orientation`, then by the least that
/// lays y along the bone. A joint without a bone has the turned ones. O(joints^2).
/// \throws Error usage when the skeleton's joints are not the template's, or there are not as many orientations.
template <typename Scalar>
[[nodiscard]] Orientations<Scalar> bone_axes(const KinematicSkeleton<Scalar>& skeleton,
                                             const SkeletonTemplate& skeleton_template,
                                             const Orientations<Scalar>& orientations);

} // namespace skelgen::applications

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/applications/impl/bone_orientations.hpp>
#endif
