#pragma once

#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/core/skeleton_template.hpp>

namespace skelgen::anatomy {

/// The skeleton with its joints moved from the middle of their sections to their bones, which lie off the middle where
/// flesh covers them unevenly: a knee to the front and the outside of it, and towards the ankle when it is bent, a
/// bent elbow towards the wrist, the shoulder outwards along its limb and to the front, the neck's base to the back,
/// and sideways and up with the shoulders. `skeleton` is in template order, with its sides told; joints that a template
/// leaves out move nothing. The offsets are calibrated: mean offsets from 50 registered bodies and from landmarks of 11
/// people, halfway between; how a neck goes with the shoulders, on either alike, as slopes. An adapted template's
/// neck does not: figures have their shoulders at any height. O(joints).
template <typename Scalar>
[[nodiscard]] KinematicSkeleton<Scalar> apply_joint_offsets(KinematicSkeleton<Scalar> skeleton,
                                                            const SkeletonTemplate& skeleton_template);

} // namespace skelgen::anatomy

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/anatomy/impl/joint_offsets.hpp>
#endif
