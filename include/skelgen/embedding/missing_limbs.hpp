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

/// A template in a curve.
struct FittingTemplate {
    SkeletonTemplate skeleton_template;
    Embedding embedding; ///< of that template in the curve
};

/// The template in the curve. As embed. \returns the failure of embed.
template <typename Scalar>
[[nodiscard]] Outcome<FittingTemplate> fitting_template(const CurveSkeleton<Scalar>& curve,
                                                        const SkeletonTemplate& skeleton_template,
                                                        const MatchingOptions& options = {});

/// The templates of bodies that lack the head, an arm, a leg, a forearm or a calf, as far as the template has these.
/// Limbs are the left ones: sides are told later.
[[nodiscard]] std::vector<SkeletonTemplate> partial_templates(const SkeletonTemplate& skeleton_template);

/// The partial templates in the curve, the least distorted first, at most `most`; none where the given one lacks a limb
/// already. As embed, for each of them.
template <typename Scalar>
[[nodiscard]] std::vector<FittingTemplate> fitting_without_limb(const CurveSkeleton<Scalar>& curve,
                                                                const SkeletonTemplate& skeleton_template,
                                                                std::size_t most, const MatchingOptions& options = {});

/// The distortion of an embedding, on average over the pairs of its nodes: templates of different limbs compare. On 96
/// registered bodies 0.005 at most, on those with a limb cut off 0.006 without that limb, and 0.008 at least without
/// another.
[[nodiscard]] double distortion_per_pair(const Embedding& embedding);

} // namespace skelgen::embedding

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/embedding/impl/missing_limbs.hpp>
#endif
