#pragma once

#include <string>
#include <utility>
#include <vector>

#include "correspondences.hpp"
#include "generated_set.hpp"

namespace skelgen::repeatability {

/// Each body on the one `step` places on; errors are of up to 200 vertices spread over each body's list whose places
/// both bodies have, landmarks likewise. Sides are those of the skin's places.
[[nodiscard]] CorrespondenceScores score_correspondences(const GeneratedSet& set, std::size_t step);

/// How far measures are from what the body's own parameters give.
struct MeasureError {
    std::string name;
    double mean = 0;  ///< of the relative differences' sizes, over all bodies
    double worst = 0; ///< of them
    int without = 0;  ///< bodies for which one of both has no such measure
};

/// Lengths against those between the joints that the body was generated with, height against the one asked for, girths
/// against those at the places that the true joints give.
[[nodiscard]] std::vector<MeasureError> measure_errors(const GeneratedSet& set);

} // namespace skelgen::repeatability
