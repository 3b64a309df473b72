#pragma once

#include <vector>

#include <skelgen/curve/branch_sections.hpp>
#include <skelgen/curve/branched_curve.hpp>

namespace skelgen::curve {

/// The smoothing spline through the sections' centres: the sum of their squared distances, each times its section's
/// weight, and of the squared curvature times a length to the fourth, `stiffness` times the thickness, is least.
/// Branches bend, and meet at their knots at any angle: where no section counts, a branch goes on straight. \param
/// branched with lines of evenly spaced points. \param sections per branch and point of its line. \param tips per knot,
/// a place that holds it weakly where it is an end. O(k).
template <typename Scalar>
[[nodiscard]] BranchedCurve<Scalar>
smoothing_spline(BranchedCurve<Scalar> branched, const std::vector<std::vector<BranchSection<Scalar>>>& sections,
                 const std::vector<Vector3<Scalar>>& tips, const PlacesOfKnots<Scalar>& junctions, double stiffness);

} // namespace skelgen::curve

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/curve/impl/smoothing_spline.hpp>
#endif
