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
    t_pose, ///< the template's rest pose: arms level, to the sides, and shoulders as high as they then are
    a_pose, ///< the same with the arms lowered by 45 degrees
};

namespace detail {

/// Per joint the way to it from its parent; of the root none.
template <typename Scalar>
[[nodiscard]] std::vector<Vector3<Scalar>> lines_from_parents(const KinematicSkeleton<Scalar>& skeleton);

/// Ways from parents, as of girdle_lines, with the shoulders so much higher where the joints move by `motions`, then
/// together as far from the chest as they were.
template <typename Scalar>
[[nodiscard]] std::vector<Vector3<Scalar>> with_shoulders_higher(std::vector<Vector3<Scalar>> lines, Scalar higher,
                                                                 const std::vector<RigidMotion<Scalar>>& motions,
                                                                 const SkeletonTemplate& skeleton_template);

} // namespace detail

/// The orientations that joints have in a pose, for a body with +y up that faces +z. `now`: those it has, which
/// `as_is` turns as a whole by `to_canonical`. O(joints).
template <typename Scalar>
[[nodiscard]] Orientations<Scalar> orientations_in(RestPose pose, const SkeletonTemplate& skeleton_template,
                                                   const Orientations<Scalar>& now,
                                                   const Eigen::Quaternion<Scalar>& to_canonical);

/// The way to each joint from its parent, at the parent's first orientation, once the shoulders lie to the chest as the
/// model's do, both together as far from it as they were: they go up and forwards with raised arms. Those of other
/// joints are as they are. `from` and `to`: the orientations of both skeletons' joints. O(joints).
/// \throws Error usage when the skeletons' joints are not the template's.
template <typename Scalar>
[[nodiscard]] std::vector<Vector3<Scalar>>
girdle_lines(const KinematicSkeleton<Scalar>& skeleton, const Orientations<Scalar>& from,
             const KinematicSkeleton<Scalar>& model, const Orientations<Scalar>& to,
             const SkeletonTemplate& skeleton_template);

/// What each joint does to the parts of the body that are fixed to it when the joints turn from the orientations `from`
/// to `to`: forward kinematics. Joints keep their places relative to their parents, or take those of `lines`, see
/// girdle_lines; the root goes to `root`. O(joints).
/// \throws Error usage when there are not as many orientations as joints.
template <typename Scalar>
[[nodiscard]] std::vector<RigidMotion<Scalar>>
motions(const KinematicSkeleton<Scalar>& skeleton, const Orientations<Scalar>& from, const Orientations<Scalar>& to,
        const Vector3<Scalar>& root, const std::vector<Vector3<Scalar>>& lines = {});

/// The same to a rest pose, with the root at the origin. In the T- and the A-pose shoulders lie to the chest as the
/// template's do (girdle_lines), but at the height at which people hold them with arms so raised
/// (core::usual_shoulder_height). `now`, `to_canonical`: as in orientations_in. O(joints).
/// \throws Error usage when the skeleton's joints are not the template's.
template <typename Scalar>
[[nodiscard]] std::vector<RigidMotion<Scalar>>
rest_motions(RestPose pose, const KinematicSkeleton<Scalar>& skeleton, const SkeletonTemplate& skeleton_template,
             const Orientations<Scalar>& now, const Eigen::Quaternion<Scalar>& to_canonical);

/// The skeleton moved likewise: joints and end points by their joints' motions, the frame by the root's. O(joints).
template <typename Scalar>
[[nodiscard]] KinematicSkeleton<Scalar> moved(const KinematicSkeleton<Scalar>& skeleton,
                                              const SkeletonTemplate& skeleton_template,
                                              const std::vector<RigidMotion<Scalar>>& motions);

} // namespace skelgen::applications

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/applications/impl/posing.hpp>
#endif
