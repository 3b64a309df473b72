#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "registered_set.hpp"

namespace skelgen::repeatability {

/// Which segmentation of a body is looked at.
using PartsOf = applications::Segmentation RegisteredBody::*;

/// For each pair of a set's bodies the part of the first one's area whose vertices have the same part on both.
[[nodiscard]] std::vector<double> agreements(const RegisteredSet& set, PartsOf parts);

/// The largest part of a body's area, over all pairs, whose vertices are on the left of one and on the right of the
/// other.
[[nodiscard]] double worst_exchange(const RegisteredSet& set, PartsOf parts);

/// All lengths, and the girths that there are, by name.
[[nodiscard]] std::map<std::string, double> named_measures(const applications::Measurements& measures);

/// For each measure by its name the standard deviation over a person's bodies relative to its mean, the mean over all
/// persons. A person's bodies are those whose names agree but for the last character.
[[nodiscard]] std::vector<std::pair<std::string, double>> measure_spreads(const RegisteredSet& set);

} // namespace skelgen::repeatability
