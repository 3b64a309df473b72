#pragma once

#include <vector>

#include <Eigen/Core>

#include <skelgen/core/mesh.hpp>
#include <skelgen/core/precision.hpp>
#include <skelgen/surface/body.hpp>

namespace skelgen::applications {

/// How much of each label is at each vertex, n x `count`, rows summing to 1: by where random walks over a length of
/// about `length` that start there end (Gra05): (L + A / length^2) x = A / length^2 p for each label's indicator p.
/// `labels` has n entries from 0 to `count` - 1. \throws Error bad_input when the surface has no area. O(n^1.5 + n
/// count).
template <typename Scalar>
[[nodiscard]] Eigen::MatrixX<core::Accumulator> part_shares(const Body<Scalar>& body, const std::vector<int>& labels,
                                                            int count, double length);

} // namespace skelgen::applications

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/applications/impl/part_shares.hpp>
#endif
