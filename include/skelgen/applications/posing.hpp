#pragma once

#include <vector>

#include <skelgen/applications/bone_orientations.hpp>
#include <skelgen/applications/canonical_frame.hpp>
#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/core/skeleton_template.hpp>

namespace skelgen::applications {

/// How a body is to be held.
enum class RestPose {
    as_is,  ///< as it is
    t_pose, ///< the template's rest pose: arms level, to the sides
    a_pose, ///< the same with the arms lowered by 45 degrees
};

/// The orientations that joints have in a pose, for a body with +y up that faces +z. `now`: those it has, which
/// `as_is` turns as a whole by `to_canonical`. O(joints).
template <typename Scalar>
[[nodiscard]] Orientations<Scalar> orientations_in(RestPose pose, const SkeletonTemplate& skeleton_template,
                                                   const Orientations<Scalar>& now,
                                                   const Eigen::Quaternion<Scalar>& to_canonical);

/// What each joint does to the parts of the body that are fixed to it when the joints turn from the orientations `from`
/// to `to`: forward kinematics. Joints keep their places relative to their parents; the root goes to `root`. O(joints).
/// \throws Error usage when there are not as many orientations as joints.
template <typename Scalar>
[[nodiscard]] std::vector<RigidMotion<Scalar>> motions(const KinematicSkeleton<Scalar>& skeleton,
                                                       const Orientations<Scalar>& from, const Orientations<Scalar>& to,
                                                       const Vector3<Scalar>& root);

/// The skeleton moved likewise: joints and end points by their joints' motions, the frame by the root's. O(joints).
template <typename Scalar>
[[nodiscard]] KinematicSkeleton<Scalar> moved(const KinematicSkeleton<Scalar>& skeleton,
                                              const SkeletonTemplate& skeleton_template,
                                              const std::vector<RigidMotion<Scalar>>& motions);

} // namespace skelgen::applications

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/applications/impl/posing.hpp>
#endif
