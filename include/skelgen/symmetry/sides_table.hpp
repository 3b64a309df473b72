// Written by `./dev calibrate`: what the probability that left and right are told apart rightly is made of. Fitted on
// 7168 candidates of 487 meshes by 228 makers whose limbs are right; tests/calibration/calibrate.py says how, and how
// well on makers left out.
#pragma once

#include <array>

namespace skelgen::symmetry {

/// What a unit of each SideWitness (sides.hpp) adds to the log odds: of foot, knee, elbow, head, sole, face.
inline constexpr std::array<double, 6> side_weights{0.5897, 1.12, 1.526, 13.79, 2.485, 98.56};
/// What counts of it at most: three root mean squares.
inline constexpr std::array<double, 6> side_limits{4.782, 1.798, 1.471, 0.1545, 3.046, 0.05381};

} // namespace skelgen::symmetry
