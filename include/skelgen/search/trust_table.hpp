// Written by `./dev calibrate`: what the probability that a skeleton is right is made of. No unit. Fitted on 16282
// candidates of 713 meshes by 403 makers; tests/calibration/calibrate.py says how, and how well on makers left out.
#pragma once

#include <array>

#include <skelgen/search/evidence.hpp>

namespace skelgen::search {

inline constexpr double trust_offset = -5.2209;
inline constexpr std::array<double, witness_count> trust_weights{
    // unmatched_reach, fitted, posed, fit_cost, envelope, lacks_head, ... in the order of Witness
    -25.291, 1.2218,  -0.34758, -0.29888, 1.2122,   -3.0182,  -1.3096, -0.93554, 2.2445,  -2.21,   -2.1888, -3.9293,
    -4.6835, -1.3653, -0.92156, -0.82555, 0.043171, -0.23108, -1.5005, 2.6547,   0.06992, -2.7663, 3.0265,  -0.78936};
inline constexpr std::array<double, witness_count> trust_means{
    0.050906,  0.32787, 0.18906,  1.0586,  0.28872, 0.044328, 0.072217,   0.186,
    -0.041096, 0.89418, 0.090363, 0.28924, 0.17882, 0.40923,  -0.0054068, -0.07336,
    0.11632,   0.46964, 0.19597,  0.74692, 0.53454, 0.25187,  0.12077,    0.52711};
/// Of the squares of those that `curved_witnesses` names, in its order.
inline constexpr std::array<double, curved_witnesses.size()> trust_square_weights{-2.8232,  -0.66488, -0.67492,
                                                                                  -0.15946, -1.9983,  -1.1824};
inline constexpr std::array<double, curved_witnesses.size()> trust_square_means{0.21791, 0.25999, 0.32734,
                                                                                0.96894, 0.12228, 0.039934};
inline constexpr double joint_trust_offset = 1.52, joint_trust_of_whole = 0.4755, joint_trust_of_doubt = 0.785;

} // namespace skelgen::search
