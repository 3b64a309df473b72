#pragma once

#include <vector>

#include <skelgen/curve/branch_sections.hpp>
#include <skelgen/curve/branched_curve.hpp>
#include <skelgen/surface/body.hpp>

namespace skelgen::curve {

/// Ends where the axes of their branches leave the surface: over the cap of a limb, which is as long as the limb is
/// thick before it, the branch goes on straight, up to just inside the surface. A branch whose sections do not say
/// where its cap begins stays as it is. `sections` as of the lines before they were moved. O(k) and a ray for each end.
template <typename Scalar>
[[nodiscard]] BranchedCurve<Scalar> ends_on_axes(BranchedCurve<Scalar> branched,
                                                 const std::vector<std::vector<BranchSection<Scalar>>>& sections,
                                                 const Body<Scalar>& body);

} // namespace skelgen::curve

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/curve/impl/axis_ends.hpp>
#endif
