#pragma once

namespace skelgen::synth {

/// How the 14 limbs of a body hang together.
enum class LimbPieces {
    whole,  ///< one surface
    closed, ///< each by itself, closed, reaching into its neighbours
    open,   ///< likewise, without what is hidden in the neighbours
    apart   ///< a robot of boxes and balls, pelvis and chest two of them, that do not touch; without clothes
};

/// The pieces that a body is put together from, as characters of games and films are.
struct BodyPieces {
    LimbPieces limbs = LimbPieces::whole;
    bool seams = false;   ///< front and back of every limb have vertices of their own
    bool face = false;    ///< eyes, half in the head, and two rows of teeth inside of it
    bool clothes = false; ///< clothes are open shells around the naked body; otherwise they are one surface with it
    double gap = 0.5;     ///< of limbs that are apart, between one and the next, in thicknesses of the limb

    [[nodiscard]] bool any() const { return limbs != LimbPieces::whole || seams || face || clothes; }
};

} // namespace skelgen::synth
