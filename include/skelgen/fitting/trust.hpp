#pragma once

#include <skelgen/core/kinematic_skeleton.hpp>

namespace skelgen::fitting {

/// Where a body has grown together with itself limbs may have been mistaken, wherever it was opened. So much less can
/// the skeleton be trusted: a working value, that of bodies which were cut.
inline constexpr double trust_in_grown_together = 0.75;

/// A surface that was made of pieces, or leaves some out, is not what was given: its limbs may have been fused or
/// shortened. So much less can the skeleton be trusted: a working value, that of bodies which were cut.
inline constexpr double trust_in_repaired = 0.75;

/// A skeleton that can be trusted no more than this part of what it is trusted otherwise.
template <typename Scalar>
KinematicSkeleton<Scalar> less_certain(KinematicSkeleton<Scalar> skeleton, double often_right) {
    skeleton.quality.sides_confidence *= often_right;
    for (Joint<Scalar>& joint : skeleton.joints) joint.confidence *= often_right;
    return skeleton;
}

} // namespace skelgen::fitting
