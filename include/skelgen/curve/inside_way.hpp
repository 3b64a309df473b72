#pragma once

#include <skelgen/curve/branch_sections.hpp>
#include <skelgen/curve/branched_curve.hpp>
#include <skelgen/curve/medial_balls.hpp>

namespace skelgen::curve {

/// The curve with the pieces of its branches that run outside the surface, between points inside, replaced by ways
/// inside: the shortest ones through the centres of inscribed balls, of which each reaches into the next. Such pieces
/// are where contraction has drawn limbs together that touch. A piece that no chain of balls leads around stays.
/// \param sections per branch and point of its line. \param balls n, of the surface or a coarse one of it. Without such
/// a piece O(points), else O(n log n).
template <typename Scalar>
[[nodiscard]] BranchedCurve<Scalar> led_inside(BranchedCurve<Scalar> branched,
                                               const std::vector<std::vector<BranchSection<Scalar>>>& sections,
                                               const MedialBalls<Scalar>& balls);

} // namespace skelgen::curve

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/curve/impl/inside_way.hpp>
#endif
