#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include <skelgen/core/skeleton_template.hpp>
#include <skelgen/search/rest_fit.hpp>
#include <skelgen/surface/body.hpp>

namespace skelgen::search {

/// A body in some pose, laid into a surface.
struct PosedFit {
    Points<double> joints;                             ///< per joint of the template, in the body's coordinates
    std::vector<std::pair<int, Vector3<double>>> tips; ///< joints that end limbs, and where these end
    SkeletonTemplate skeleton_template;                ///< the given one with the proportions that were found
    double cost = 0;       ///< how badly surface, middles, proportions and what is known are met; robust; 0 best
    std::size_t start = 0; ///< from which of the starts
    std::vector<double> proportions; ///< as proportions_table.hpp has them
};

/// Joints of persons and figures who stand at rest as large as the body, along each of its principal axes and turned
/// each way about it: 216 of them, in the body's coordinates, one row per joint of the template. None where it
/// is no person's template with all limbs.
template <typename Scalar>
[[nodiscard]] std::vector<Points<double>> standing_starts(const Body<Scalar>& body, const SkeletonTemplate& wanted);

/// Lays a jointed model in any pose into a surface, from skeletons that may be wrong. Head, trunk and the bones of the
/// limbs are cones with round ends. Their ends and radii, 59 numbers, are brought to where the surface's places lie on
/// them and their axes in its middle, both robust against what the body wears and holds. Broad priors hold both sides
/// alike, lengths and radii as people and figures have them, knees and elbows bent as they can be. `starts`: places of
/// the template's joints in the body's coordinates, each with the likeliest radii for its lengths. `known`: joints'
/// places there. All starts are fitted by few places, the cheapest of those that differ by more. \returns the cheapest
/// fits that differ, at most twelve, the cheapest first; none where `wanted` is no person's template with all limbs, or
/// the surface encloses nothing. O(n log n) for the surface, and a millisecond for each start.
template <typename Scalar>
[[nodiscard]] std::vector<PosedFit> fit_posed(const Body<Scalar>& body, const SkeletonTemplate& wanted,
                                              const std::vector<Points<double>>& starts,
                                              const std::vector<KnownPlace>& known = {});

} // namespace skelgen::search

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/search/impl/posed_fit.hpp>
#endif
