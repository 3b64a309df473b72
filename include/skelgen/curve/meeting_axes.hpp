#pragma once

#include <vector>

#include <skelgen/curve/branch_sections.hpp>
#include <skelgen/curve/branched_curve.hpp>
#include <skelgen/surface/body.hpp>

namespace skelgen::curve {

/// How far from a knot the sections of a branch that leaves it are its own: where it has parted from the others, as two
/// tubes as thick as the ball at the knot do, at the ball's radius times the cotangent of half the angle between them,
/// and a bit. `branch` is one of the curve's, seen from its first knot or, `at_end`, from its last one. O(points of
/// the branches).
template <typename Scalar>
[[nodiscard]] Scalar own_distance(const BranchedCurve<Scalar>& curve, std::size_t branch, bool at_end,
                                  std::type_identity_t<Scalar> ball);

/// Per knot, the place where the axes of its branches meet, if it is a junction at which they do: each branch that is
/// long enough runs straight where its own sections begin, through their centres, and on from there these lines pass
/// by one place near the knot, to which they run inside the surface. So tubes meet, and shoulders do not. \param
/// sections per branch and point of its line. \param straightness the points through which an axis is laid may be off
/// it by this part of the ball's radius. O(branches points).
template <typename Scalar>
[[nodiscard]] PlacesOfKnots<Scalar> meeting_axes(const BranchedCurve<Scalar>& curve,
                                                 const std::vector<std::vector<BranchSection<Scalar>>>& sections,
                                                 const Body<Scalar>& body, double straightness);

} // namespace skelgen::curve

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/curve/impl/meeting_axes.hpp>
#endif
