#pragma once

#include <optional>

#include <skelgen/refinement/bend.hpp>
#include <skelgen/refinement/limbs.hpp>
#include <skelgen/refinement/profile_matcher.hpp>

namespace skelgen::refinement {

/// Where the centreline of a leg turns from the calf to the foot, whatever both look like and however long they are: at
/// the end of the first of the two lines, one after the other, that its points from the tip to the knee are nearest to.
/// Joints are where `rest` has them, roughly: most of the calf suffices. None where there are too few points, or
/// where it is straight, as on a body that stands on its toes. O(k^2) for k sections.
template <typename Scalar>
[[nodiscard]] std::optional<Heel<Scalar>> find_heel(const Limb<Scalar>& limb, const Stretch<Scalar>& rest,
                                                    const BendOptions& options = {});

} // namespace skelgen::refinement

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/refinement/impl/heel.hpp>
#endif
