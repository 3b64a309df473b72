// Written by `./dev calibrate`: what the probability that a skeleton is right is made of. No unit. Fitted on 19779
// candidates of 1271 meshes by 335 makers; tests/calibration/calibrate.py says how, and how well on makers left out.
#pragma once

#include <array>

#include <skelgen/search/evidence.hpp>

namespace skelgen::search {

inline constexpr double trust_offset = -3.5963;
inline constexpr std::array<double, witness_count> trust_weights{
    // unmatched_reach, fitted, posed, fit_cost, envelope, lacks_head, ... in the order of Witness
    -13.464,  1.851,    -1.4118, -0.15543, 0.77363, -1.202,  -1.2232, -0.5435,  1.128,
    -2.1078,  -3.2503,  -6.1433, -5.7891,  -4.1438, -2.1884, -0.4001, -0.92949, -0.023146,
    -0.30822, -0.52084, 2.2793,  0.40735,  -2.9491, 1.3693,  -1.2032};
inline constexpr std::array<double, witness_count> trust_means{
    0.029112, 0.43096,  0.35011, 1.4044,   0.21997, 0.017232, 0.093601, 0.19625,   -0.0027474,
    0.73339,  0.085785, 0.23277, 0.058077, 0.15265, 0.32307,  0.018918, -0.052748, 0.1303,
    0.39013,  0.18325,  0.82349, 0.70716,  0.22668, 0.11058,  0.53859};
/// Of the squares of those that `curved_witnesses` names, in its order.
inline constexpr std::array<double, curved_witnesses.size()> trust_square_weights{-2.9831,  -0.063407, -0.62629,
                                                                                  -0.26069, -3.0886,   4.0221};
inline constexpr std::array<double, curved_witnesses.size()> trust_square_means{0.13943, 0.16868, 0.22151,
                                                                                0.87618, 0.10375, 0.029784};
inline constexpr double joint_trust_offset = 1.948, joint_trust_of_whole = 0.4142, joint_trust_of_doubt = 1.241;

} // namespace skelgen::search
