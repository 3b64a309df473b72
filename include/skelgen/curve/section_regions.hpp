#pragma once

#include <vector>

#include <skelgen/curve/branch_centring.hpp>
#include <skelgen/surface/body.hpp>

namespace skelgen::curve {

/// Per node of a curve the radius of the ball around it that touches the surface. O(k log faces).
template <typename Scalar>
[[nodiscard]] std::vector<Scalar> ball_radii(const Points<Scalar>& nodes, const Body<Scalar>& body);

/// The curve of centred branches: each node with the radius of the ball around it that touches the surface, and with
/// the vertices that are nearest along the surface to the section across its branch or to its ball, of those that
/// belonged to its branch: `origin_of_vertex` says so for each, by the numbers of Branch::origins. Every vertex comes
/// into one region. O(n log n).
template <typename Scalar>
[[nodiscard]] CurveSkeleton<Scalar> curve_with_regions(const CentredBranches<Scalar>& centred, const Body<Scalar>& body,
                                                       const std::vector<int>& origin_of_vertex);

} // namespace skelgen::curve

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/curve/impl/section_regions.hpp>
#endif
