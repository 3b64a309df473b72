#pragma once

#include <vector>

#include <skelgen/core/mesh.hpp>
#include <skelgen/hands/digit_tubes.hpp>

namespace skelgen::hands {

/// The phalanges of a digit as a chain of balls whose radii change along each phalanx.
template <typename Scalar = double>
struct PhalanxChain {
    std::vector<Vector3<Scalar>> places = {}; ///< joints from the innermost one on, and the centre of the end's ball
    std::vector<Scalar> radii = {};           ///< per place
};

/// What is known of a digit before its surface is looked at.
template <typename Scalar = double>
struct ExpectedPhalanges {
    std::vector<Scalar> shares = {}; ///< of each phalanx in their sum, which is 1; the last one's ends on the surface
    Scalar length = 0;               ///< of all together
};

/// The chain whose surface a tube's own is nearest to, as hands are tracked (TPT16): its joints are where the digit
/// bends. Where it is straight, nothing but what is expected tells them. Starts from the given chain; Gauss-Newton,
/// always as many steps. The chain itself where the tube has too few points. O(points).
template <typename Scalar>
[[nodiscard]] PhalanxChain<Scalar> fit_phalanges(const DigitTube<Scalar>& tube, PhalanxChain<Scalar> start,
                                                 const ExpectedPhalanges<Scalar>& expected);

} // namespace skelgen::hands

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/hands/impl/phalanx_fit.hpp>
#endif
