#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "registered_set.hpp"

namespace skelgen::repeatability {

/// How well the bodies of a set are found on each other.
struct CorrespondenceScores {
    std::vector<double> errors;          ///< for each pair the mean geodesic distance to the true place over sqrt(area)
    std::vector<std::string> pairs;      ///< their names
    std::vector<double> landmark_errors; ///< for each landmark of each pair
    std::vector<std::pair<double, double>> trusted; ///< for each vertex looked at its confidence and its error
    double exchanged = 0; ///< the part of the limbs' vertices, over all pairs, sent to the other side
    double seconds = 0;   ///< for a pair, once both bodies are made comparable
};

/// `step`, or one more where that would bring each of `count` bodies onto itself.
[[nodiscard]] constexpr std::size_t places_on(std::size_t step, std::size_t count) {
    return step % count == 0 ? step + 1 : step;
}

/// Each body on the one 17 places on: in sets ordered by person and ten poses another person in another pose. Errors
/// are of 100 vertices spread over each body's list.
[[nodiscard]] CorrespondenceScores score_correspondences(const RegisteredSet& set);

} // namespace skelgen::repeatability
