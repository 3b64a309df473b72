// Written by `./dev calibrate`: what the probability that a skeleton is right is made of. No unit. Fitted on 7726
// candidates of 458 meshes by 240 makers; tests/calibration/calibrate.py says how, and how well on makers left out.
#pragma once

#include <array>

#include <skelgen/search/evidence.hpp>

namespace skelgen::search {

inline constexpr double trust_offset = -6.35;
inline constexpr std::array<double, witness_count> trust_weights{
    // distortion, unmatched, unmatched_reach, clutter_head, clutter_hands, clutter_back, ... in the order of Witness
    -0.43504, -1.3409,  -25.396,  2.2008,  -3.5898,  -4.0397,  -1.5165, 0.074118, 0.8709,   -0.40046, -0.46752,
    -3.8751,  -0.72598, 0.30005,  1.4795,  0.73149,  0.54305,  0.59241, 1.6514,   -0.83601, 0.40439,  0.068708,
    1.5924,   -2.3907,  -0.57477, -1.4084, -5.1665,  -5.0891,  13,      -1.4752,  -6.4612,  -1.638,   -1.9053,
    0.3897,   1.883,    -2.7716,  0.43275, -0.39453, -0.42268, -0.3497, -1.4111,  4.3501,   0.4818,   -2.9404};
inline constexpr std::array<double, witness_count> trust_means{
    -0.15691,  0.1752,    0.079894, 0.0052591, 0.0077907, 0.058969, 0.10318, 0.24821,  0.097541,  0.31189, 0.21178,
    0.085211,  0.14458,   0.32554,  -0.058111, 0.23573,   0.043822, 0.09546, 0.013061, 0.0037725, 0.19339, 0.017778,
    0.014103,  0.8608,    0.11032,  0.08967,   0.16684,   0.19175,  0.94427, -0.66028, 0.13255,   0.42705, 0.46927,
    -0.018892, -0.083878, -0.11756, -0.14502,  0.047739,  -0.24645, 0.30058, 0.20722,  0.71873,   0.47977, 0.051845};
/// Of bodies at rest that would be likelier than not the share that is right on makers left out.
inline constexpr double trust_in_rest_fits = 0.667;
inline constexpr double joint_trust_offset = 0.4185, joint_trust_of_whole = 0.5226, joint_trust_of_doubt = 0.3885;

} // namespace skelgen::search
