#pragma once

#include <numbers>
#include <optional>
#include <vector>

#include <skelgen/applications/bone_orientations.hpp>
#include <skelgen/applications/canonical_frame.hpp>
#include <skelgen/applications/posing.hpp>
#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/core/skeleton_template.hpp>

namespace skelgen::applications {

/// The pose of a body as `bone_orientations`, but where it stands in a T- or an A-pose, both sides alike, as those do
/// who were made to be moved: there trunk, head and soles are taken to be as the template has them at rest, whatever
/// the bones in them say (the way from ankle to ball is not the sole's, that from chin to crown not the face's), arms
/// to be turned from the T-pose by the least that leads to their directions, and hands as the forearms are.
/// `to_canonical`: turns the body upright and to face +z. O(joints^2). \throws Error as `bone_orientations`.
template <typename Scalar>
[[nodiscard]] Orientations<Scalar> posture(const KinematicSkeleton<Scalar>& skeleton,
                                           const SkeletonTemplate& skeleton_template,
                                           const Eigen::Quaternion<Scalar>& to_canonical);

/// As `rest_motions`, but what lies within some degrees of the rest pose stays as it is. The trunk does where its line
/// is within 15 degrees, and hips and shoulders lie across within 30, else where its joints are within 15. Arms (12)
/// and legs (15) of both sides do by the lines from their first joint to their last, where elbows or knees lie near
/// these. Soles stay within 35, or whatever they do below legs that are down within 35. The head stays within 25, or
/// whatever it does where the trunk is upright within 25. These two stay as they are turned in the world. Hands of arms
/// that stay do so, too. Arms that are bent by less than 60 degrees are laid where they are wanted without a turn about
/// themselves, and hands go with the forearms. Arms that are raised or lowered take the shoulders along as people's do.
/// `now`: as of `posture`. O(joints). \throws Error as `rest_motions`.
template <typename Scalar>
[[nodiscard]] std::vector<RigidMotion<Scalar>>
posture_motions(RestPose pose, const KinematicSkeleton<Scalar>& skeleton, const SkeletonTemplate& skeleton_template,
                const Orientations<Scalar>& now, const Eigen::Quaternion<Scalar>& to_canonical);

/// Directions as near to an axis of the coordinates are meant to be along it: 20 degrees, radians. A working value.
inline constexpr double near_axes = 20 * std::numbers::pi / 180;

/// Of a rotation that about y which leaves what looks ahead, along z, in the same vertical plane.
template <typename Scalar>
[[nodiscard]] Eigen::Quaternion<Scalar> about_vertical(const Eigen::Quaternion<Scalar>& rotation);

/// The rotation that takes axes to axes and is within 20 degrees of this one: a scene that is upright, or has another
/// axis up or ahead, stays as level as it is. None where none is so near.
template <typename Scalar>
[[nodiscard]] std::optional<Eigen::Quaternion<Scalar>> along_axes(const Eigen::Quaternion<Scalar>& rotation);

} // namespace skelgen::applications

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/applications/impl/rest_posture.hpp>
#endif
