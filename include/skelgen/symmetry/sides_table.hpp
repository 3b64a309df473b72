// Written by `./dev calibrate`: what the probability that left and right are told apart rightly is made of. Fitted on
// 8588 candidates of 912 meshes by 459 makers whose limbs are right; tests/calibration/calibrate.py says how, and how
// well on makers left out.
#pragma once

#include <array>

namespace skelgen::symmetry {

/// What a unit of each SideWitness (sides.hpp) adds to the log odds: of foot, knee, elbow, head, sole, face.
inline constexpr std::array<double, 6> side_weights{0.1864, 1.469, 0.7885, 29.78, 2.78, 88.81};
/// What counts of it at most: three root mean squares.
inline constexpr std::array<double, 6> side_limits{4.464, 1.928, 1.51, 0.109, 3.141, 0.05212};

} // namespace skelgen::symmetry
