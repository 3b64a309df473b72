#pragma once

#include <vector>

#include "correspondences.hpp"
#include "registered_set.hpp"

namespace skelgen::repeatability {

[[nodiscard]] double mean_of(const std::vector<double>& values);

/// The value that `part` of all are below.
[[nodiscard]] double quantile(std::vector<double> values, double part);

/// Errors, sides, time, and what vertices of little and of much confidence are off by.
void print_correspondences(const CorrespondenceScores& scores);

/// Each border's length over its limb's girth.
void print_borders(const std::vector<const RegisteredBody*>& bodies);

} // namespace skelgen::repeatability
