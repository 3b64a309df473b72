// Written by `./dev calibrate`: what the probability that a skeleton is right is made of. No unit. Fitted on 14751
// candidates of 1007 meshes by 505 makers; tests/calibration/calibrate.py says how, and how well on makers left out.
#pragma once

#include <array>

#include <skelgen/search/evidence.hpp>

namespace skelgen::search {

inline constexpr double trust_offset = -2.8972;
inline constexpr std::array<double, witness_count> trust_weights{
    // unmatched_reach, fitted, posed, fit_cost, envelope, lacks_head, ... in the order of Witness
    -8.6483,  1.2434,  -1.2283, -0.32441, 0.32386, -2.7639, -1.7657, -0.71566, 2.0074,
    -1.6375,  -2.7303, -5.3968, -4.7668,  -3.7545, -2.0954, -1.0785, -1.0854,  0.1588,
    -0.32236, -1.215,  2.7687,  0.25832,  -3.4324, 3.0618,  -1.2165};
inline constexpr std::array<double, witness_count> trust_means{
    0.017855, 0.47262,  0.3691,  1.5508,   0.25868, 0.0094607, 0.027512, 0.09107,  -0.012323,
    0.73645,  0.088867, 0.25732, 0.066512, 0.14646, 0.31666,   0.038401, -0.06007, 0.14127,
    0.38811,  0.16532,  0.81803, 0.69457,  0.10828, 0.087733,  0.458};
/// Of the squares of those that `curved_witnesses` names, in its order.
inline constexpr std::array<double, curved_witnesses.size()> trust_square_weights{-1.9778,  -0.64232, -0.59566,
                                                                                  -0.32433, -1.8843,  2.6566};
inline constexpr std::array<double, curved_witnesses.size()> trust_square_means{0.14864, 0.18265,  0.24761,
                                                                                0.88333, 0.094419, 0.032954};
inline constexpr double joint_trust_offset = 1.523, joint_trust_of_whole = 0.4931, joint_trust_of_doubt = 1.03;

} // namespace skelgen::search
