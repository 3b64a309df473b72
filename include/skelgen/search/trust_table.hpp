// Written by `./dev calibrate`: what the probability that a skeleton is right is made of. No unit. Fitted on 14956
// candidates of 644 meshes by 334 makers; tests/calibration/calibrate.py says how, and how well on makers left out.
#pragma once

#include <array>

#include <skelgen/search/evidence.hpp>

namespace skelgen::search {

inline constexpr double trust_offset = -4.8268;
inline constexpr std::array<double, witness_count> trust_weights{
    // unmatched_reach, fitted, posed, fit_cost, adapted, envelope, ... in the order of Witness
    -23.057, 0.39687, -0.22995, -0.21034, 0.6758,  0.95042, -2.9618,  -1.0405,  -0.96404,
    2.0391,  -1.9314, -3.6889,  -4.1325,  -3.9578, -1.1678, -0.83345, -0.53967, -0.0029671,
    -0.3236, -2.1477, 1.7782,   0.19317,  -2.6497, 2.8092,  -0.78638};
inline constexpr std::array<double, witness_count> trust_means{
    0.050609,  0.32962, 0.18804,  1.0652,  0.40011, 0.31012, 0.046719,  0.075597,  0.1913,
    -0.052544, 0.89173, 0.090914, 0.29468, 0.18243, 0.40193, 0.0031802, -0.076356, 0.10838,
    0.46704,   0.20658, 0.75646,  0.54145, 0.2509,  0.12063, 0.53444};
/// Of the squares of those that `curved_witnesses` names, in its order.
inline constexpr std::array<double, curved_witnesses.size()> trust_square_weights{-2.3781,  -1.0281, 0.075862,
                                                                                  -0.22062, -1.513,  -1.7691};
inline constexpr std::array<double, curved_witnesses.size()> trust_square_means{0.2165,  0.26327, 0.31292,
                                                                                0.98071, 0.12121, 0.04483};
inline constexpr double joint_trust_offset = 1.366, joint_trust_of_whole = 0.4693, joint_trust_of_doubt = 0.7367;

} // namespace skelgen::search
