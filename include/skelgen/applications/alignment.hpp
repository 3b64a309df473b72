#pragma once

#include <Eigen/Core>

#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/surface/body.hpp>

namespace skelgen::applications {

/// Directions of the pelvis, which is what stands still while a body bends: left across the hips, up along the lower
/// trunk. Neither is of length 1, nor are they at right angles.
template <typename Scalar = double>
struct PelvisDirections {
    Vector3<Scalar> left, up;
};

/// Left is from the right hip to the left one. Up is a mean of the directions from between the hips to crotch, waist
/// and chest: where the trunk bends, their errors point against each other. The waist, the nearest that is apart from
/// the hips, counts twice, the chest, beyond the bend, half. An animal's trunk lies: up is across the line from its
/// hips to its chest, and left is that of hips and shoulders. \throws Error usage when a joint of human21 or quadruped
/// is missing. O(joints).
template <typename Scalar>
[[nodiscard]] PelvisDirections<Scalar> pelvis_directions(const KinematicSkeleton<Scalar>& skeleton);

/// As above, but left is the normal of the plane in which the pelvis's back mirrors itself (`mirror_plane`). Hips
/// follow thighs that are drawn up or back, buttocks and loins do so less. Up is at right angles to it. Where the
/// surface says nothing, or is 35 degrees and more from the hips, their line stays; an animal's always does. `skeleton`
/// in the input's coordinates, and so the result. O(n log n).
template <typename Scalar>
[[nodiscard]] PelvisDirections<Scalar> pelvis_directions(const Body<Scalar>& body,
                                                         const KinematicSkeleton<Scalar>& skeleton);

/// Where an aligned body's origin lies.
enum class AlignedOrigin {
    crotch, ///< in the crotch joint, of an animal in its hips
    floor,  ///< below the crotch joint, as low as the lowest vertex
};

struct AlignmentOptions {
    AlignedOrigin origin = AlignedOrigin::crotch;
    double scale = 1; ///< aligned lengths over those given; one over standing_height for bodies of equal height
};

/// \throws Error usage when the scale is out of its range.
void validate(const AlignmentOptions& options);

/// The transform, 4 x 4, that brings a body into common directions (LF20 section 5.1). Its pelvis's up becomes +y
/// exactly, and its left as nearly +x as that allows, so that it faces +z (Khr21). A uniform scale, a proper rotation
/// and a translation, to be applied to columns (x, y, z, 1). `vertices` (n x 3) in the skeleton's coordinates. \throws
/// Error usage when a joint of human21 is missing, there is no vertex or an option is out of its range. O(n).
template <typename Scalar>
[[nodiscard]] Eigen::Matrix<Scalar, 4, 4> alignment(const KinematicSkeleton<Scalar>& skeleton,
                                                    const Points<Scalar>& vertices,
                                                    const AlignmentOptions& options = {});

/// As above, by the directions that the body's surface gives, too: what is repeated best where bodies bend. `vertices`:
/// the input's that the body was made of. O(n log n).
template <typename Scalar>
[[nodiscard]] Eigen::Matrix<Scalar, 4, 4> alignment(const Body<Scalar>& body, const KinematicSkeleton<Scalar>& skeleton,
                                                    const Points<Scalar>& vertices,
                                                    const AlignmentOptions& options = {});

/// Points moved by a 4 x 4 transform; n x 3. O(n).
template <typename Scalar>
[[nodiscard]] Points<Scalar> transformed(const Points<Scalar>& points, const Eigen::Matrix<Scalar, 4, 4>& transform);

} // namespace skelgen::applications

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/applications/impl/alignment.hpp>
#endif
