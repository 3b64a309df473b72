#pragma once

#include <optional>
#include <vector>

#include <skelgen/core/curve_skeleton.hpp>
#include <skelgen/core/header_only.hpp>
#include <skelgen/core/skeleton_template.hpp>
#include <skelgen/embedding/embed.hpp>
#include <skelgen/embedding/spectral_matching.hpp>

namespace skelgen::embedding {

/// The template of a body that lacks a limb.
struct PartialTemplate {
    SkeletonTemplate skeleton_template; ///< with joints that are absent, see without_limb
    int end = -1;                       ///< the joint in which the limb would end
};

/// The templates of bodies that lack the head, an arm, a leg, a forearm or a calf, as far as the template has these.
/// Limbs are the left ones: sides are told later.
[[nodiscard]] std::vector<PartialTemplate> partial_templates(const SkeletonTemplate& skeleton_template);

/// The distortion of an embedding, on average over the pairs of its nodes: templates of different limbs compare. On 96
/// registered bodies 0.005 at most, on those with a limb cut off 0.006 without that limb, and 0.008 at least without
/// another.
[[nodiscard]] double distortion_per_pair(const Embedding& embedding);

/// Whether the curve is rather that of a body that lacks a limb, although the whole template could be laid into it as
/// `whole`: without that limb it is less than half as distorted, also than without hands or feet alone, and what stands
/// for the limb is much too short, as a stump is. A head is there, however short beside long limbs, where the curve's
/// balls shrink to a neck and grow again. \returns the template that fits so, the least distorted; none for a whole
/// body, or where the given template already lacks a limb. As embed, for each partial template, but for curves that fit
/// the whole one well, which most bodies' do: these take no time.
template <typename Scalar>
[[nodiscard]] std::optional<PartialTemplate>
find_missing_limb(const CurveSkeleton<Scalar>& curve, const SkeletonTemplate& skeleton_template, const Embedding& whole,
                  const MatchingOptions& options = {});

} // namespace skelgen::embedding

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/embedding/impl/missing_limbs.hpp>
#endif
