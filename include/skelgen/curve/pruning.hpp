#pragma once

#include <skelgen/core/curve_skeleton.hpp>
#include <skelgen/curve/branched_curve.hpp>
#include <skelgen/surface/body.hpp>

namespace skelgen::curve {

/// Lengths of the leaf branches to cut, relative to the largest distance along the curve (LF20 section 3.1). Two
/// levels: a foot can be as short as a spur on the head, but only once the heel's spur is gone does it continue the
/// leg.
struct PruningOptions {
    double spur = 0.015;  ///< heels and similar artefacts
    double branch = 0.06; ///< fingers, ears, nose
};

/// Those that leave fingers, tails, horns and table legs.
inline constexpr PruningOptions pruning_for_digits{0.01, 0.02};

/// \throws Error usage when an option is out of its range.
void validate(const PruningOptions& options);

/// Two-level pruning of leaf branches; regions of cut nodes go to the node they hung on. Regions are in ascending order
/// before and after. O(k^2 log k + b n log n) where b branches are cut. \throws Error usage when an option is out of
/// its range.
template <typename Scalar>
[[nodiscard]] CurveSkeleton<Scalar> prune(const CurveSkeleton<Scalar>& curve, const PruningOptions& options = {});

/// Cuts leaf branches that stick out less than `least_relief` times the radius of the ball at the junction that they
/// leave, beyond that ball: the least first, again and again. One that is long, twice that radius, and lies but for its
/// tip in the balls around other branches does not stick out at all. O(b k^2) for b branches that are cut, of a curve
/// of k points.
template <typename Scalar>
[[nodiscard]] BranchedCurve<Scalar> prune_twigs(BranchedCurve<Scalar> branched, const Body<Scalar>& body,
                                                double least_relief);

} // namespace skelgen::curve

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/curve/impl/pruning.hpp>
#endif
