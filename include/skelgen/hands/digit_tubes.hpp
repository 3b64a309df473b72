#pragma once

#include <vector>

#include <skelgen/core/mesh.hpp>
#include <skelgen/hands/hand_surface.hpp>

namespace skelgen::hands {

/// A digit as the surface shows it, before it has a name: a tube that ends.
template <typename Scalar = double>
struct DigitTube {
    std::vector<Vector3<Scalar>> axis;        ///< from where it joins its neighbours to its end on the surface
    std::vector<Scalar> radii;                ///< per place on the axis: the girth there over two pi; 0 at the end
    std::vector<int> vertices;                ///< of the hand's surface beyond where it joins them
    std::vector<Vector3<Scalar>> points = {}; ///< where these are
    std::vector<Scalar> areas = {};           ///< of the surface around each
    Scalar joins = 0;      ///< distance from the forearm along the surface where it joins another one
    Scalar ends = 0;       ///< and that of its end
    bool is_alone = false; ///< there is no other: the axis is that of the hand's outer half
};

/// Which parts of a surface are digits, relative to the hand's length.
struct DigitBounds {
    double least = 0.1; ///< that they stand out by, calibrated: shorter stubs are knuckles and folds
    double nearest = 0; ///< distance from the forearm at which they join another one
};

/// The digits of a hand's surface: where distances from the forearm have maxima that stand out from where the parts
/// beyond them meet (persistence: EH08), within the bounds: knuckles and nails do not. Tubes
/// that leave the hand's surroundings are none, as what is held, or the body behind a hand that lies on it. Nor are
/// those that join the rest too far from knuckles or forearm, as the other hand's. Of more than five those that stand
/// out most are taken. A hand without any is one tube, if its end is there. In no order. `place` is in the surface's
/// unit. O(n log n).
template <typename Scalar>
[[nodiscard]] std::vector<DigitTube<Scalar>> find_tubes(const HandSurface<Scalar>& hand, const HandPlace<Scalar>& place,
                                                        const DigitBounds& bounds = {});

} // namespace skelgen::hands

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/hands/impl/digit_tubes.hpp>
#endif
