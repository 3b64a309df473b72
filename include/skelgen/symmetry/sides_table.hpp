// Written by `./dev calibrate`: what the probability that left and right are told apart rightly is made of. Fitted on
// 7739 candidates of 518 meshes by 257 makers whose limbs are right; tests/calibration/calibrate.py says how, and how
// well on makers left out.
#pragma once

#include <array>

namespace skelgen::symmetry {

/// What a unit of each SideWitness (sides.hpp) adds to the log odds: of foot, knee, elbow, head, sole, face.
inline constexpr std::array<double, 6> side_weights{0.6958, 0.8379, 1.916, 13.27, 2.404, 83.33};
/// What counts of it at most: three root mean squares.
inline constexpr std::array<double, 6> side_limits{4.815, 1.862, 1.457, 0.1607, 3.046, 0.05277};

} // namespace skelgen::symmetry
