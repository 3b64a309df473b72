#pragma once

#include <skelgen/core/curve_skeleton.hpp>
#include <skelgen/embedding/embed.hpp>
#include <skelgen/refinement/placement.hpp>

namespace skelgen::refinement {

/// Places the joints that are all that is left of a limb (see is_bare): a shoulder or hip as the mirror image of the
/// other side's, a neck as far above the shoulders as at rest. The other shoulder and hip and, unless it is bare, the
/// neck must have been placed. O(k) for k nodes of the curve.
template <typename Scalar>
[[nodiscard]] Placement<Scalar> place_bare_joints(Placement<Scalar> placement, const CurveSkeleton<Scalar>& curve,
                                                  const embedding::Embedding& embedding);

} // namespace skelgen::refinement

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/refinement/impl/bare_joints.hpp>
#endif
