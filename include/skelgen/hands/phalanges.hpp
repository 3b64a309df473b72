#pragma once

#include <vector>

#include <skelgen/core/skeleton_template.hpp>
#include <skelgen/hands/digit.hpp>
#include <skelgen/hands/digit_tubes.hpp>
#include <skelgen/hands/hand_surface.hpp>

namespace skelgen::hands {

/// Names the digits of a hand and divides them into phalanges. The thumb is the one that leaves the hand clearly
/// nearest to the forearm, of two the thinner one; the others stand in a row from it on: index, middle, ring, little,
/// and where there are fewer, the last ones are missing; without a thumb the little finger is at the end where they are
/// shorter. One that is as wide as several, and flat, is these together. Joints are first put on the digit's axis, at
/// the parts of its length beyond the web that they have in people and in characters alike (medians of the rigs of five
/// groups of makers), the knuckle behind the web straight on. Those of digits that are one each are then fitted to the
/// surface (`fit_phalanges`). In the order of the digits; empty without tubes. O(points of the tubes).
template <typename Scalar>
[[nodiscard]] std::vector<FoundDigit<Scalar>> name_digits(const std::vector<DigitTube<Scalar>>& tubes,
                                                          const HandPlace<Scalar>& place, Side side);

/// Names the toes of a foot from the big one, which is on its inner side, and gives each two joints. The first one is
/// behind its web by three quarters of the way from the webs to the ball of the foot, the second one in the middle of
/// the toe. One that is as wide as several is these together; fewer than two tubes show no toes. `up` leads from the
/// ball towards the ankle. In the order of the digits. O(tubes).
template <typename Scalar>
[[nodiscard]] std::vector<FoundDigit<Scalar>> name_toes(const std::vector<DigitTube<Scalar>>& tubes,
                                                        const HandPlace<Scalar>& place, Side side,
                                                        const Vector3<Scalar>& up);

} // namespace skelgen::hands

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/hands/impl/phalanges.hpp>
#endif
