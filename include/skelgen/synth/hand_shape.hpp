#pragma once

#include <array>
#include <cstddef>

#include <skelgen/core/skeleton_template.hpp>
#include <skelgen/hands/digit.hpp>

namespace skelgen::synth {

/// How one digit of a hand holds itself. Angles in degrees, on top of the pose's.
struct DigitShape {
    double curl = 0;     ///< at each of its joints, -10 to 90: fingers into the palm, the thumb across it
    double spread = 0;   ///< away from the hand's middle, -5 to 15; the thumb from the palm
    bool joined = false; ///< grown together with the next finger, over its whole length; not the thumb

    friend bool operator==(const DigitShape&, const DigitShape&) = default;
};

/// What a hand holds: a thing of its own, as thick as there is room for.
enum class HeldThing { none, rod, staff, ball };

/// What a hand looks like. Digits that are not joined should stay apart by some millimetres: where surfaces just touch,
/// meshing takes long, and mostly ends in an error.
struct HandShape {
    int digits = 5;                    ///< 2 to 5: a thumb and the fingers, all thicker where they are fewer
    std::array<DigitShape, 5> digit{}; ///< from the thumb on; those that there are
    double glove = 0;                  ///< thickness in metres, 0 to 0.006
    HeldThing holds = HeldThing::none;

    friend bool operator==(const HandShape&, const HandShape&) = default;
};

/// \throws Error usage naming the field, its value and its range.
void check_hand(const HandShape& hand);

/// Where the joints of a digit are, metres.
struct DigitTruth {
    Side side = Side::none;
    hands::Digit digit = hands::Digit::thumb;
    std::array<Vector3<double>, hands::phalanges> joints; ///< from the knuckle on; the thumb's metacarpal from its base
    Vector3<double> tip = Vector3<double>::Zero();        ///< its end on the surface
    /// The surface does not tell it from the digit before it: the middles between the second and the third joints of
    /// both lie inside, or both end in the palm.
    bool is_fused = false;
};

} // namespace skelgen::synth
