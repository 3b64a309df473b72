#pragma once

#include <vector>

#include <skelgen/core/curve_skeleton.hpp>
#include <skelgen/core/skeleton_template.hpp>
#include <skelgen/embedding/spectral_matching.hpp>
#include <skelgen/surface/body.hpp>

namespace skelgen::search {

/// The body without what its hands hold: staffs, swords, axes. These are the branches of its curve that end at a fork
/// from which only one other branch leads on, or what a branch has beyond the length of another one. Without what is
/// held at one such place, or at two forks, the template fits, a person's well or its legs lead on from the trunk, and
/// each of these places is a hand; of several ways the least distorted, and one hand rather than two. The surface is
/// cut where the branches leave the ball at the hand; for a second body the straightest one where it has gone on as far
/// as the other hand does, so that it passes for fingers. What was done is added to the repairs. `curve` as from
/// find_curve, its regions the body's vertices. \returns two bodies, or none where nothing is held so. As embed, for
/// each way: at most 15, and one for each two ends of the curve.
template <typename Scalar>
[[nodiscard]] std::vector<Body<Scalar>>
without_held_things(const Body<Scalar>& body, const CurveSkeleton<Scalar>& curve, const SkeletonTemplate& wanted,
                    const embedding::MatchingOptions& options);

} // namespace skelgen::search

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/search/impl/held_things.hpp>
#endif
