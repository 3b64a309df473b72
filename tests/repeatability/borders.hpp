#pragma once

#include <map>
#include <string>
#include <vector>

#include "registered_set.hpp"

namespace skelgen::repeatability {

/// For each border between two parts of a limb, or of limb and trunk, by the part beyond it without its side, how long
/// it is relative to the girth of the limb there (`measure`), on each body that has both. Borders run from the middle
/// of an edge between two parts to that of the next.
[[nodiscard]] std::map<std::string, std::vector<double>>
border_lengths(const std::vector<const RegisteredBody*>& bodies);

} // namespace skelgen::repeatability
