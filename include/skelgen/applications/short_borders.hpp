#pragma once

#include <vector>

#include <Eigen/Core>

#include <skelgen/core/precision.hpp>
#include <skelgen/surface/body.hpp>

namespace skelgen::applications {

/// Labels whose borders are short: each two that meet are parted anew where the line between them, over the surface, is
/// shortest, by the cheapest cut (KT03). A vertex resists, by its area over `length`, as much as there is of its label
/// in it; the core of each label stays, so none is lost, and what is nearer to a label's mirror image does not go to
/// it. `labels`, n, and `shares`, n x count, as from `part_shares` over that `length`, in the body's unit; `mirrored`,
/// count: per label the one on the other side, or itself. O(n pairs) and what the cuts take, nearly linear in the
/// vertices near borders.
template <typename Scalar>
[[nodiscard]] std::vector<int> with_short_borders(const Body<Scalar>& body, std::vector<int> labels,
                                                  const Eigen::MatrixX<core::Accumulator>& shares, double length,
                                                  const std::vector<int>& mirrored);

} // namespace skelgen::applications

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/applications/impl/short_borders.hpp>
#endif
