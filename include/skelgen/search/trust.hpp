#pragma once

#include <vector>

#include <skelgen/core/header_only.hpp>
#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/search/evidence.hpp>

namespace skelgen::search {

/// The probability that a skeleton is right: limbs where they are, sides not exchanged, joints near their places
/// (docs/results.md says how it was measured). Its log odds are linear in the evidence and in the squares of some
/// proportions; the numbers are of trust_table.hpp, fitted by `./dev calibrate`. It orders candidates, refuses what is
/// less likely than `least_probability`, and is the confidence.
[[nodiscard]] double probability_right(const Evidence& evidence);

/// What is left of a probability to be right beside the one that a skeleton of another plan has: one of them is right
/// at most, and each has its odds against neither. The same where that is 0.
[[nodiscard]] inline double probability_beside(double own, double other) {
    return own < 1 ? own * (1 - other) / (1 - own * other) : 1;
}

/// Less likely skeletons are no answer.
inline constexpr double least_probability = 0.1;

/// Less likely answers are more often wrong than right: guesses, which say so.
inline constexpr double likely_enough = 0.5;

/// So many that disagree with it are thought beside all candidates: that one other agrees says little by itself.
inline constexpr double dissenters = 3;

/// A candidate that is likelier ends the search: to go on would take longer and seldom lead to another.
inline constexpr double sure_enough = 0.95;

/// The skeleton with the confidence of its sides and joints, decided once: the probability that it is right, and of a
/// joint the probability that it lies within 3 % of the geodesic diameter from its place, by its doubt
/// (anatomy::joint_doubts) and that of the whole.
template <typename Scalar>
[[nodiscard]] KinematicSkeleton<Scalar> with_confidence(KinematicSkeleton<Scalar> skeleton, double probability,
                                                        const std::vector<double>& doubt);

/// The witness that speaks most against a skeleton, as a clause of a sentence: "its proportions are unusual".
[[nodiscard]] const char* strongest_doubt(const Evidence& evidence);

} // namespace skelgen::search

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/search/impl/trust.hpp>
#endif
