#pragma once

#include <vector>

#include "registered_set.hpp"

namespace skelgen::repeatability {

/// How far the pelvis of each body of a set is turned against that of the medoid, once all are aligned; degrees. The
/// pelvis is what lies around the crotch of the first body, behind and beside it: its vertices within 0.12 of the
/// geodesic diameter, from 0.01 below to 0.07 above, no farther forward than 0.02.
[[nodiscard]] std::vector<double> pelvis_turns(const RegisteredSet& set);

} // namespace skelgen::repeatability
