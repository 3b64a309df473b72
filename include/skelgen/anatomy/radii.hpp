#pragma once

#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/surface/body.hpp>

namespace skelgen::anatomy {

/// The skeleton with every joint's radius: mean distance to the contour around it across the bone from its parent (for
/// the root: to a child). A radius stays as it is where there is no contour within half the bone's length.
/// O(joints (n + m)).
template <typename Scalar>
[[nodiscard]] KinematicSkeleton<Scalar> measure_radii(KinematicSkeleton<Scalar> skeleton, const Body<Scalar>& body);

} // namespace skelgen::anatomy

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/anatomy/impl/radii.hpp>
#endif
