// Written by `./dev calibrate`: what the probability that left and right are told apart rightly is made of. Fitted on
// 9929 candidates of 1180 meshes by 294 makers whose limbs are right; tests/calibration/calibrate.py says how, and how
// well on makers left out.
#pragma once

#include <array>

namespace skelgen::symmetry {

/// What a unit of each SideWitness (sides.hpp) adds to the log odds: of foot, knee, elbow, head, sole, face.
inline constexpr std::array<double, 6> side_weights{0.2316, 1.604, 0.9096, 33.34, 2.754, 92.52};
/// What counts of it at most: three root mean squares.
inline constexpr std::array<double, 6> side_limits{4.467, 1.96, 1.582, 0.1307, 3.102, 0.04823};

} // namespace skelgen::symmetry
