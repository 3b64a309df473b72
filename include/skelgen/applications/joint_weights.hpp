#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include <skelgen/core/precision.hpp>

namespace skelgen::applications {

/// How much each joint moves each vertex: n x joints, from 0 to 1, rows sum to 1. Double whatever the mesh's scalar: it
/// comes out of a factorisation. A vertex's lie together.
using JointWeights = Eigen::Matrix<core::Accumulator, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// How much a vertex follows the joints below a border, and all others.
struct Shares {
    core::Accumulator below = 0, above = 0;
};

/// `is_below` per joint, see joints_below. O(joints).
[[nodiscard]] inline Shares shares_of(const JointWeights& weights, Eigen::Index v, const std::vector<bool>& is_below) {
    Shares out;
    for (std::size_t j = 0; j < is_below.size(); ++j)
        (is_below[j] ? out.below : out.above) += weights(v, static_cast<Eigen::Index>(j));
    return out;
}

/// Gives that part of what a vertex follows to the joints below a border, and the rest to the others; among themselves
/// these keep their proportions. There must be some of both. O(joints).
inline void divide_shares(JointWeights& weights, Eigen::Index v, const std::vector<bool>& is_below,
                          core::Accumulator part_below) {
    const auto [below, above] = shares_of(weights, v, is_below);
    const core::Accumulator all = below + above;
    const core::Accumulator more_below = all * part_below / below, more_above = all * (1 - part_below) / above;
    for (std::size_t j = 0; j < is_below.size(); ++j)
        weights(v, static_cast<Eigen::Index>(j)) *= is_below[j] ? more_below : more_above;
}

} // namespace skelgen::applications
