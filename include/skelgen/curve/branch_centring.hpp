#pragma once

#include <vector>

#include <skelgen/curve/branch_sections.hpp>
#include <skelgen/curve/branched_curve.hpp>
#include <skelgen/surface/body.hpp>

namespace skelgen::curve {

/// How branches are laid into the middle of the surface.
struct BranchCentringOptions {
    /// Distance between nodes along the curve, relative to the diagonal of the body's bounding box as it
    /// lies (in canonical form, where a turned body lies alike).
    double spacing = 0.01;
    int rounds = 9; ///< of cutting across and moving, two thirds of them at twice the spacing; calibrated
    /// The curve does not bend within less than this part of its sections' thickness; calibrated.
    double stiffness = 0.4;
    /// Branches that stick out less than this many radii of the ball at their junction, beyond it, go.
    double least_relief = 0.5;
};

/// \throws Error usage when an option is out of its range.
void validate(const BranchCentringOptions& options);

/// Branches in the middle of the surface, and the sections across them.
template <typename Scalar = double>
struct CentredBranches {
    BranchedCurve<Scalar> branched;
    std::vector<std::vector<BranchSection<Scalar>>> sections; ///< per branch and point of its line
};

/// Moves branches to where the surface's cross-sections have their centres, in rounds: points evenly spaced, a section
/// across each, a smoothing spline through the sections' centres as far as these are the branch's own. Where straight
/// axes of branches meet, as those of tubes do, the branches go straight on to that place from where their own sections
/// begin.
/// An end lies where the axis of its branch leaves the surface, and branches that have come to run along each other
/// become one up to where they part. Then each branch that runs far inside others is joined to them where the way is
/// best centred, twigs go, and points outside the surface are moved into their sections. O(rounds k) sections. \throws
/// Error usage when an option is out of its range.
template <typename Scalar>
[[nodiscard]] CentredBranches<Scalar> centre_branches(BranchedCurve<Scalar> branched, const Body<Scalar>& body,
                                                      const BranchCentringOptions& options = {});

/// The same roughly, in an eighth of the time: in three rounds, all but the last at twice the spacing. Branches stay
/// joined where they were, and points outside there. Enough to lay a template into the curve. O(k) sections.
/// \throws as centre_branches.
template <typename Scalar>
[[nodiscard]] BranchedCurve<Scalar> centre_roughly(BranchedCurve<Scalar> branched, const Body<Scalar>& body,
                                                   const BranchCentringOptions& options = {});

} // namespace skelgen::curve

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/curve/impl/branch_centring.hpp>
#endif
