#pragma once

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

} // namespace skelgen::embedding

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/embedding/impl/missing_limbs.hpp>
#endif
