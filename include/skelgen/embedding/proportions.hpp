#pragma once

#include <cstddef>
#include <vector>

#include <skelgen/core/curve_skeleton.hpp>
#include <skelgen/core/header_only.hpp>
#include <skelgen/core/outcome.hpp>
#include <skelgen/core/skeleton_template.hpp>
#include <skelgen/embedding/embed.hpp>
#include <skelgen/embedding/spectral_matching.hpp>

namespace skelgen::embedding {

/// How large head and limbs are beside the trunk, as multiples of the template's: the head from its joint on, arms
/// below the shoulders, legs below the hips, with their thickness; and how far apart the hips are.
struct Proportions {
    double head = 1, arms = 1, legs = 1, hips = 1;
};

/// The template with these proportions, its trunk else as it was, said to be adapted. O(joints).
[[nodiscard]] SkeletonTemplate with_proportions(const SkeletonTemplate& skeleton_template,
                                                const Proportions& proportions);

/// The proportions with which head, arms and legs are as long beside the trunk as a whole template's embedding in a
/// curve has them, within those of drawn figures; hips as the given template has them. Without a trunk, as where arms
/// and legs leave at one junction, all 1. O(n log n) for n curve nodes.
template <typename Scalar>
[[nodiscard]] Proportions proportions_of(const CurveSkeleton<Scalar>& curve, const Embedding& embedding,
                                         const SkeletonTemplate& skeleton_template);

/// Do both legs lead on from where the trunk ends, the same way? Those of figures that stand, walk or lie do, those of
/// animals on four feet do not: their tails do at most. False where a leg or the trunk's end is absent. O(joints).
template <typename Scalar>
[[nodiscard]] bool legs_go_on(const CurveSkeleton<Scalar>& curve, const Embedding& embedding,
                              const SkeletonTemplate& skeleton_template);

/// A template as it fits a curve.
struct FittingTemplate {
    SkeletonTemplate skeleton_template;
    Embedding embedding; ///< of that template in the curve
    bool is_odd = false; ///< its proportions are other than those that were given
};

/// Of the template and its like with the proportions of children and of drawn figures the one that is least distorted
/// by being laid into the curve. Another than the given one only where that is much distorted, and it less than half as
/// much and hardly, with next to nothing left over: animals do not fit so, with any of these proportions. Where the
/// legs go on from the trunk, which animals' do not, the curve's own proportions are tried, too, and may be distorted
/// more, by what figures wear and carry. A template that lacks a limb stays as it is. As embed, for each of them, but
/// for curves that fit the given one well, which most bodies' do: these take no time. \returns the failure of embed.
template <typename Scalar>
[[nodiscard]] Outcome<FittingTemplate> fitting_proportions(const CurveSkeleton<Scalar>& curve,
                                                           const SkeletonTemplate& skeleton_template,
                                                           const MatchingOptions& options = {});

/// The template in other ways: with the proportions of children and drawn figures, with those that the curve itself
/// says, from each of these, and without a limb. Each assignment of the curve's ends and junctions comes once, with the
/// template that it distorts least; the least distorted first, at most `most`. As embed, some dozens of times.
template <typename Scalar>
[[nodiscard]] std::vector<FittingTemplate>
other_fitting_templates(const CurveSkeleton<Scalar>& curve, const SkeletonTemplate& skeleton_template, std::size_t most,
                        const MatchingOptions& options = {});

} // namespace skelgen::embedding

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/embedding/impl/proportions.hpp>
#endif
