#pragma once

#include <vector>

#include <skelgen/core/outcome.hpp>
#include <skelgen/core/stage_timings.hpp>
#include <skelgen/curve/find_curve.hpp>
#include <skelgen/embedding/proportions.hpp>
#include <skelgen/search/evidence.hpp>
#include <skelgen/search/extract_options.hpp>
#include <skelgen/search/rest_fit.hpp>
#include <skelgen/surface/body.hpp>

namespace skelgen::search {

/// A skeleton in the body's coordinates, what speaks for and against it, and how likely it is right.
template <typename Scalar = double>
struct Candidate {
    KinematicSkeleton<Scalar> skeleton; ///< confidences as trust.hpp has them
    Evidence evidence;
    double probability = 0;
    Scalar geodesic_diameter = 0; ///< largest geodesic distance on the body, estimated
    std::vector<double> doubt;    ///< per joint: anatomy::joint_doubts
    StageTimings timings;         ///< of embed, refine and sides
};

/// What LF20's Fig. 1 shows from the embedding on: joints placed by cross-sections and anatomy, sides told apart, the
/// skeleton completed. A pure function: no other curve, template or surface is tried. `laid`: the template in the
/// curve. \returns failure too_compact for a curve that is a point, flat_trunk where trunk or hips have no extent.
template <typename Scalar>
[[nodiscard]] Outcome<Candidate<Scalar>> skeleton_of(const Body<Scalar>& body, const curve::CurveResult<Scalar>& curve,
                                                     const embedding::FittingTemplate& laid,
                                                     const ExtractOptions& options = {});

/// The same for a body at rest that was laid into the surface (rest_fit.hpp); the curve serves as the middle that
/// joints come inside towards.
template <typename Scalar>
[[nodiscard]] Outcome<Candidate<Scalar>> skeleton_of(const Body<Scalar>& body, const curve::CurveResult<Scalar>& curve,
                                                     const RestFit<Scalar>& fit, const ExtractOptions& options = {});

/// The same with the template laid into the curve in the likeliest way (embedding::fitting_proportions): the paper's
/// straight line from a body and its curve to its skeleton. \returns the failure of embed, too. \throws Error usage
/// when an option is out of its range, bad_input when the template breaks a rule.
template <typename Scalar>
[[nodiscard]] Outcome<Candidate<Scalar>> skeleton_of(const Body<Scalar>& body, const curve::CurveResult<Scalar>& curve,
                                                     const SkeletonTemplate& skeleton_template,
                                                     const ExtractOptions& options = {});

} // namespace skelgen::search

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/search/impl/line.hpp>
#endif
