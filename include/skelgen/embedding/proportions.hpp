#pragma once

#include <skelgen/core/header_only.hpp>
#include <skelgen/core/skeleton_template.hpp>

namespace skelgen::embedding {

/// How large head and limbs are beside the trunk, as multiples of the template's: the head from its joint on, arms
/// below the shoulders, legs below the hips, with their thickness; and how far apart the hips are.
struct Proportions {
    double head = 1, arms = 1, legs = 1, hips = 1;
};

/// The template with these proportions, its trunk else as it was, said to be adapted. O(joints).
[[nodiscard]] SkeletonTemplate with_proportions(const SkeletonTemplate& skeleton_template,
                                                const Proportions& proportions);

} // namespace skelgen::embedding

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/embedding/impl/proportions.hpp>
#endif
