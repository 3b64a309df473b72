#pragma once

#include <vector>

#include "registered_set.hpp"

namespace skelgen::repeatability {

/// How well the bodies of a set are found on each other.
struct CorrespondenceScores {
    std::vector<double> errors;          ///< for each pair the mean geodesic distance to the true place over sqrt(area)
    std::vector<double> landmark_errors; ///< for each landmark of each pair
    double exchanged = 0;                ///< the part of the limbs' vertices, over all pairs, sent to the other side
    double seconds = 0;                  ///< for a pair, once both bodies are made comparable
};

/// Each body on the one 17 places on: in sets ordered by person and ten poses another person in another pose. Errors
/// are of 100 vertices spread over each body's list.
[[nodiscard]] CorrespondenceScores score_correspondences(const RegisteredSet& set);

} // namespace skelgen::repeatability
