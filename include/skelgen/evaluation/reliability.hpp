#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <skelgen/evaluation/evaluate.hpp>

namespace skelgen::evaluation {

/// The joints whose confidence lies in one interval.
struct ReliabilityBin {
    double from = 0, to = 0;    ///< of the confidence; without `to`, but for the last bin
    std::size_t joints = 0;     ///< in the interval
    std::size_t near = 0;       ///< of them, within the distance asked for
    double mean_confidence = 0; ///< of them; 0 where there are none
};

/// A distance to the truth, over its scale, that is small beside a limb: what confidences are calibrated for.
inline constexpr double near_the_truth = 0.03;

/// How often joints are near the truth, by the confidence that they were given, in `bins` intervals of equal length.
/// Skeletons count whether they are solved or not; those that are not complete, and joints without a confidence or of
/// which the truth says nothing, do not. O(joints).
/// \throws Error usage when there is to be no bin.
[[nodiscard]] std::vector<ReliabilityBin> reliability(const std::vector<SetScore>& sets, std::size_t bins = 10,
                                                      double near = near_the_truth);

/// An array with an object for each bin: from, to, joints, near, mean_confidence.
[[nodiscard]] std::string reliability_to_json(const std::vector<ReliabilityBin>& bins);

} // namespace skelgen::evaluation
