#pragma once

#include <skelgen/anatomy/confidence.hpp>
#include <skelgen/core/curve_skeleton.hpp>
#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/core/outcome.hpp>
#include <skelgen/core/skeleton_template.hpp>
#include <skelgen/surface/body.hpp>

namespace skelgen::anatomy {

/// Completes a skeleton whose sides are told and whose joints lie in the middle of their sections: joints to their
/// bones, like bones on both sides, all joints inside, their radii, and last, from where the joints then are, their
/// confidences. `curve` is the one that the template was laid into. \returns failure no_match when more than one joint
/// in six would lie outside the body, or the bones of more than one in five would have unlikely lengths: that is more
/// than what is left of a body where limbs have been mistaken for each other. O(joints (n + m)).
template <typename Scalar>
[[nodiscard]] Outcome<JudgedSkeleton<Scalar>>
complete_skeleton(KinematicSkeleton<Scalar> sided, const Body<Scalar>& body, const CurveSkeleton<Scalar>& curve,
                  const SkeletonTemplate& skeleton_template);

} // namespace skelgen::anatomy

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/anatomy/impl/complete.hpp>
#endif
