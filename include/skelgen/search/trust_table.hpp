// Written by `./dev calibrate`: what the probability that a skeleton is right is made of. No unit. Fitted on 19825
// candidates of 642 meshes by 346 makers; tests/calibration/calibrate.py says how, and how well on makers left out.
#pragma once

#include <array>

#include <skelgen/search/evidence.hpp>

namespace skelgen::search {

inline constexpr double trust_offset = -4.9651;
inline constexpr std::array<double, witness_count> trust_weights{
    // unmatched_reach, fitted, posed, fit_cost, adapted, envelope, ... in the order of Witness
    -26.034, 0.3269,  -0.98991, -0.24917, 1.1223,  0.85604, -3.1053,  -1.1168, -1.252,  1.8461,  -0.99852, -1.9237,
    -3.0677, -4.1039, -1.6053,  -0.27228, -0.6513, 0.20146, -0.14427, -1.5416, 0.97955, 0.39975, -2.2229,  5.7753};
inline constexpr std::array<double, witness_count> trust_means{
    0.044234, 0.59544, 0.54443, 1.8316,    0.65581,  0.25596, 0.055078, 0.073712, 0.18054, -0.056825, 0.75836, 0.11788,
    0.35045,  0.15357, 0.37488, -0.021888, -0.12121, 0.13786, 0.60751,  0.16523,  0.70196, 0.65139,   0.47512, 0.17789};
/// Of the squares of those that `curved_witnesses` names, in its order.
inline constexpr std::array<double, curved_witnesses.size()> trust_square_weights{-2.5979,  -0.83648, -0.48791,
                                                                                  -0.22046, -1.3784,  -2.4048};
inline constexpr std::array<double, curved_witnesses.size()> trust_square_means{0.13948, 0.17451,  0.23692,
                                                                                1.0786,  0.069928, 0.045004};
inline constexpr double joint_trust_offset = 1.304, joint_trust_of_whole = 0.4706, joint_trust_of_doubt = 0.9254;

} // namespace skelgen::search
