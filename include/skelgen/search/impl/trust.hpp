#pragma once

#include <skelgen/search/trust.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <skelgen/core/evidence.hpp>
#include <skelgen/search/trust_table.hpp>

namespace skelgen::search {
namespace detail {

/// What the square of a proportion adds to the logarithm of the odds; no more than for one 4.5 times an adult's.
inline double voice_of_square(const Evidence& evidence, std::size_t curved) {
    constexpr double most = 1.5;
    const double value = std::clamp(evidence[curved_witnesses[curved]], -most, most);
    return trust_square_weights[curved] * (value * value - trust_square_means[curved]);
}

/// What each witness by itself adds to the logarithm of the odds.
inline std::array<double, witness_count> voices(const Evidence& evidence) {
    std::array<double, witness_count> out;
    for (std::size_t w = 0; w < witness_count; ++w) out[w] = trust_weights[w] * (evidence.values[w] - trust_means[w]);
    for (std::size_t c = 0; c < curved_witnesses.size(); ++c)
        out[static_cast<std::size_t>(curved_witnesses[c])] += voice_of_square(evidence, c);
    return out;
}

} // namespace detail

SKELGEN_INLINE double probability_right(const Evidence& evidence) {
    double log_odds = trust_offset;
    for (const double voice : detail::voices(evidence)) log_odds += voice;
    return core::logistic(log_odds);
}

template <typename Scalar>
KinematicSkeleton<Scalar> with_confidence(KinematicSkeleton<Scalar> skeleton, double probability,
                                          const std::vector<double>& doubt) {
    skeleton.quality.sides_confidence = probability;
    const double log_odds = core::log_odds(probability);
    for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
        Joint<Scalar>& joint = skeleton.joints[j];
        joint.confidence = joint.is_present ? core::logistic(joint_trust_offset + joint_trust_of_whole * log_odds -
                                                             joint_trust_of_doubt * std::log1p(doubt[j]))
                                            : 0;
    }
    return skeleton;
}

SKELGEN_INLINE const char* strongest_doubt(const Evidence& evidence) {
    const auto voices = detail::voices(evidence);
    switch (static_cast<Witness>(std::min_element(voices.begin(), voices.end()) - voices.begin())) {
    case Witness::unmatched_reach:
    case Witness::unexplained:
        return "much of its shape belongs to no limb; separate what is joined to it";
    case Witness::reach:
        return "its shape is too compact, or too long, for one with arms and legs; check that it is one body alone";
    case Witness::lacks_head:
    case Witness::lacks_limbs:
        return "a limb or the head is not found; check that all stand free";
    case Witness::apart:
        return "limbs lie on each other; check that all stand free";
    case Witness::doubt:
    case Witness::folded:
        return "its bones would have unlikely lengths; give hints (--hint)";
    case Witness::outside:
        return "joints would lie outside of it; close holes and turn its faces outwards";
    case Witness::legs_go_on:
        return "it stands on four legs; for an animal take the template quadruped";
    default:
        return "its proportions are no person's; if it is one, give hints (--hint)";
    }
}

} // namespace skelgen::search
