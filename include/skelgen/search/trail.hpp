#pragma once

#include <optional>
#include <vector>

#include <skelgen/core/refusal.hpp>
#include <skelgen/search/hypothesis.hpp>

namespace skelgen::search {

/// One hypothesis that was tried, and what came of it.
struct Tried {
    Hypothesis hypothesis;
    Refusal refusal = Refusal::none; ///< why it has led to no skeleton; none where it has
    int candidates = 0;              ///< skeletons that it has led to
    double probability = 0;          ///< of the likeliest of them, beside what was found until then
    bool lacks_limb = false;         ///< whether that one is without a limb
    double seconds = 0;
};

/// What was tried on a mesh, in order.
using Trail = std::vector<Tried>;

} // namespace skelgen::search
