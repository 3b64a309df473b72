#pragma once

#include <skelgen/search/trust.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <skelgen/search/trust_table.hpp>

namespace skelgen::search {
namespace detail {

inline double logistic(double x) { return 1 / (1 + std::exp(-x)); }

/// What a witness adds to the logarithm of the odds.
inline double voice(const Evidence& evidence, std::size_t witness) {
    return trust_weights[witness] * (evidence.values[witness] - trust_means[witness]);
}

} // namespace detail

SKELGEN_INLINE double probability_right(const Evidence& evidence) {
    double log_odds = trust_offset;
    for (std::size_t w = 0; w < witness_count; ++w) log_odds += detail::voice(evidence, w);
    const bool is_at_rest = evidence[Witness::fitted] > 0.5;
    return detail::logistic(log_odds) * (is_at_rest ? trust_in_rest_fits : 1);
}

template <typename Scalar>
KinematicSkeleton<Scalar> with_confidence(KinematicSkeleton<Scalar> skeleton, double probability,
                                          const std::vector<double>& doubt) {
    skeleton.quality.sides_confidence = probability;
    const double log_odds = std::log(std::max(probability, 1e-9) / std::max(1 - probability, 1e-9));
    for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
        Joint<Scalar>& joint = skeleton.joints[j];
        joint.confidence = joint.is_present ? detail::logistic(joint_trust_offset + joint_trust_of_whole * log_odds -
                                                               joint_trust_of_doubt * std::log1p(doubt[j]))
                                            : 0;
    }
    return skeleton;
}

SKELGEN_INLINE const char* strongest_doubt(const Evidence& evidence) {
    std::size_t worst = 0;
    for (std::size_t w = 1; w < witness_count; ++w)
        if (detail::voice(evidence, w) < detail::voice(evidence, worst)) worst = w;
    switch (static_cast<Witness>(worst)) {
    case Witness::unmatched:
    case Witness::unmatched_reach:
    case Witness::clutter_head:
    case Witness::clutter_hands:
    case Witness::clutter_back:
    case Witness::clutter_legs:
        return "much of its shape belongs to no limb; separate what is joined to it";
    case Witness::reach:
        return "its shape is too compact, or too long, for one with arms and legs";
    case Witness::lacks_head:
    case Witness::lacks_limbs:
        return "a limb or the head is not found; check that all stand free";
    case Witness::contacts:
    case Witness::cut:
    case Witness::apart:
        return "limbs lie on each other; check that all stand free";
    case Witness::doubt:
    case Witness::misplaced:
    case Witness::pairs_lengths:
        return "its bones would have unlikely lengths";
    case Witness::outside:
    case Witness::support:
        return "joints would lie outside of it";
    case Witness::legs_go_on:
    case Witness::four_legged:
        return "it stands on four legs";
    default:
        return "its proportions are no person's";
    }
}

} // namespace skelgen::search
