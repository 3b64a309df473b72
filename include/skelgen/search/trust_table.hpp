// Written by `./dev calibrate`: what the probability that a skeleton is right is made of. No unit. Fitted on 14823
// candidates of 644 meshes by 310 makers; tests/calibration/calibrate.py says how, and how well on makers left out.
#pragma once

#include <array>

#include <skelgen/search/evidence.hpp>

namespace skelgen::search {

inline constexpr double trust_offset = -5.273;
inline constexpr std::array<double, witness_count> trust_weights{
    // unmatched_reach, fitted, posed, fit_cost, adapted, envelope, ... in the order of Witness
    -23.532,  0.27071, -0.44907, -0.15157, 0.61756, 0.89313, -3.0561,  -1.249,   -0.77002,
    2.3977,   -1.9267, -3.6356,  -4.2627,  -3.1521, -1.5081, -0.96271, -0.61222, -0.13751,
    -0.25139, -1.6732, 1.9328,   0.36125,  -2.6449, 2.9783,  -0.81754};
inline constexpr std::array<double, witness_count> trust_means{
    0.050954,  0.33208, 0.18646,  1.0764,  0.39792, 0.3112,  0.046374,  0.071141,  0.19881,
    -0.051526, 0.89094, 0.090398, 0.28867, 0.18156, 0.40366, 0.0028885, -0.074699, 0.11338,
    0.45837,   0.2,     0.7037,   0.53558, 0.25049, 0.12595, 0.53187};
/// Of the squares of those that `curved_witnesses` names, in its order.
inline constexpr std::array<double, curved_witnesses.size()> trust_square_weights{-2.8099,  -1.18,   -0.71373,
                                                                                  -0.14262, -1.6774, -0.17911};
inline constexpr std::array<double, curved_witnesses.size()> trust_square_means{0.22204, 0.26262, 0.32504,
                                                                                0.95751, 0.12443, 0.041503};
inline constexpr double joint_trust_offset = 1.313, joint_trust_of_whole = 0.5461, joint_trust_of_doubt = 0.7008;

} // namespace skelgen::search
