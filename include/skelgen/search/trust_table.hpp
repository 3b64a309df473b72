// Written by `./dev calibrate`: what the probability that a skeleton is right is made of. No unit. Fitted on 20270
// candidates of 1307 meshes by 341 makers; tests/calibration/calibrate.py says how, and how well on makers left out.
#pragma once

#include <array>

#include <skelgen/search/evidence.hpp>

namespace skelgen::search {

inline constexpr double trust_offset = -3.6769;
inline constexpr std::array<double, witness_count> trust_weights{
    // unmatched_reach, fitted, posed, fit_cost, envelope, lacks_head, ... in the order of Witness
    -13.468,  1.8407,  -1.408,  -0.15536, 0.79594, -1.201,  -1.2213,  -0.54058, 1.1796,
    -2.1086,  -3.1952, -6.1769, -5.7932,  -4.113,  -2.1885, -0.40739, -0.9156,  -0.03108,
    -0.30933, -0.5157, 2.3039,  0.41351,  -2.9436, 1.3715,  -1.1994};
inline constexpr std::array<double, witness_count> trust_means{
    0.028469, 0.44353,  0.35182, 1.4451,   0.21511, 0.016851, 0.091533, 0.19386,   -0.0088612,
    0.74024,  0.085513, 0.24625, 0.057706, 0.15,    0.32049,  0.015319, -0.061472, 0.13378,
    0.41823,  0.18197,  0.81543, 0.70663,  0.22167, 0.10883,  0.53562};
/// Of the squares of those that `curved_witnesses` names, in its order.
inline constexpr std::array<double, curved_witnesses.size()> trust_square_weights{-2.9978,  -0.055472, -0.62917,
                                                                                  -0.26371, -3.1126,   3.7328};
inline constexpr std::array<double, curved_witnesses.size()> trust_square_means{0.13967, 0.1731,  0.22965,
                                                                                0.89956, 0.10201, 0.031904};
inline constexpr double joint_trust_offset = 1.955, joint_trust_of_whole = 0.4165, joint_trust_of_doubt = 1.252;

} // namespace skelgen::search
