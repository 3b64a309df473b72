#pragma once

#include <vector>

#include <skelgen/core/curve_skeleton.hpp>
#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/surface/body.hpp>

namespace skelgen::anatomy {

/// A skeleton of which all joints lie inside the body.
template <typename Scalar = double>
struct MovedInside {
    KinematicSkeleton<Scalar> skeleton;
    std::vector<int> moved; ///< joints that were outside, ascending
};

/// Moves joints that landed outside the surface (generalized winding number of a half or less, JKS13) to the nearest
/// place inside on the way to the curve skeleton, in twentieths of it, with a warning each. O(joints n).
template <typename Scalar>
[[nodiscard]] MovedInside<Scalar> move_inside(KinematicSkeleton<Scalar> skeleton, const Body<Scalar>& body,
                                              const CurveSkeleton<Scalar>& curve);

} // namespace skelgen::anatomy

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/anatomy/impl/inside.hpp>
#endif
