#pragma once

#include <vector>

#include <skelgen/core/curve_skeleton.hpp>
#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/core/skeleton_template.hpp>
#include <skelgen/surface/body.hpp>

namespace skelgen::anatomy {

/// A skeleton with everything that files have of it but confidences, and what speaks for and against its joints.
template <typename Scalar = double>
struct CompletedSkeleton {
    KinematicSkeleton<Scalar> skeleton;
    std::vector<double> doubt; ///< per joint, as joint_doubts has it
    std::vector<int> moved;    ///< joints that were outside and have been moved inside, ascending
};

/// Completes a skeleton whose sides are told and whose joints lie in the middle of their sections: joints to their
/// bones, like bones on both sides, all joints inside, their radii, and last, from where the joints then are, the doubt
/// about each. `curve` is the one that the template was laid into. O(joints (n + m)).
template <typename Scalar>
[[nodiscard]] CompletedSkeleton<Scalar> complete_skeleton(KinematicSkeleton<Scalar> sided, const Body<Scalar>& body,
                                                          const CurveSkeleton<Scalar>& curve,
                                                          const SkeletonTemplate& skeleton_template);

/// A completed skeleton with its joints at other places, a row each, in the body's coordinates: with like bones on both
/// sides, inside and with radii measured anew. Ends of limbs go along to the nearest corner of the surface. What is
/// absent stays so. O(joints (n + m)).
template <typename Scalar>
[[nodiscard]] KinematicSkeleton<Scalar> with_joints_at(const Points<Scalar>& places, KinematicSkeleton<Scalar> skeleton,
                                                       const Body<Scalar>& body, const CurveSkeleton<Scalar>& curve,
                                                       const SkeletonTemplate& skeleton_template);

} // namespace skelgen::anatomy

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/anatomy/impl/complete.hpp>
#endif
