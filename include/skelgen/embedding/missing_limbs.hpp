#pragma once

#include <cstddef>
#include <vector>

#include <skelgen/core/curve_skeleton.hpp>
#include <skelgen/core/skeleton_template.hpp>
#include <skelgen/embedding/embed.hpp>
#include <skelgen/embedding/spectral_matching.hpp>

namespace skelgen::embedding {

/// A template in a curve.
struct LaidTemplate {
    SkeletonTemplate skeleton_template;
    Embedding embedding; ///< of that template in the curve
};

/// The distortion of an embedding, on average over the pairs of its nodes: templates of different limbs compare. On 96
/// registered bodies 0.005 at most, on those with a limb cut off 0.006 without that limb, and 0.008 at least without
/// another.
[[nodiscard]] inline double distortion_per_pair(const Embedding& embedding) {
    const double nodes = embedding.matched_nodes;
    return 2 * embedding.distortion / (nodes * (nodes - 1));
}

/// The template in the curve of a body that lacks the head, an arm, a leg, a forearm or a calf, as far as the template
/// has these; nowhere if it lacks one already. The least distorted first, at most `most`; each assignment of the
/// curve's ends and junctions once. Limbs are the left ones: sides are told later. As embed, five times.
template <typename Scalar>
[[nodiscard]] std::vector<LaidTemplate> without_a_limb(const CurveSkeleton<Scalar>& curve,
                                                       const SkeletonTemplate& skeleton_template, std::size_t most,
                                                       const MatchingOptions& options = {});

} // namespace skelgen::embedding

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/embedding/impl/missing_limbs.hpp>
#endif
