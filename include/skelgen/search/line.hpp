#pragma once

#include <utility>
#include <vector>

#include <skelgen/core/outcome.hpp>
#include <skelgen/core/stage_timings.hpp>
#include <skelgen/curve/find_curve.hpp>
#include <skelgen/embedding/missing_limbs.hpp>
#include <skelgen/search/evidence.hpp>
#include <skelgen/search/extract_options.hpp>
#include <skelgen/search/posed_fit.hpp>
#include <skelgen/search/rest_fit.hpp>
#include <skelgen/surface/body.hpp>
#include <skelgen/symmetry/sides.hpp>

namespace skelgen::search {

/// A skeleton in the body's coordinates, what speaks for and against it, and how likely it is right.
template <typename Scalar = double>
struct Candidate {
    KinematicSkeleton<Scalar> skeleton; ///< confidences as trust.hpp has them
    Evidence evidence;
    double probability = 0;
    Scalar geodesic_diameter = 0; ///< largest geodesic distance on the body, estimated
    std::vector<double> doubt;    ///< per joint: anatomy::joint_doubts
    symmetry::SideEvidence sides; ///< what tells left from right
    StageTimings timings;         ///< of embed, refine and sides
};

/// What a curve that is a point is refused for.
[[nodiscard]] inline Failure too_compact() {
    return {Refusal::too_compact,
            "no human body: too compact a shape for one with arms and legs; have limbs stand free"};
}

/// Joints of a template in a body, left and right not told apart yet, and what is known of how they came to be.
template <typename Scalar = double>
struct PlacedJoints {
    SkeletonTemplate skeleton_template;
    refinement::RefinedJoints<Scalar> joints;
    const embedding::Embedding* embedding = nullptr; ///< in the curve; none for a body at rest
    Scalar geodesic_diameter = 0;
    std::vector<std::pair<Witness, double>> evidence; ///< that the joints themselves do not show
    const Points<Scalar>* vertices = nullptr;         ///< of the input: as symmetry::front_of_surface() takes them
};

/// The joints of a template that is laid into a curve, by cross-sections and anatomy. `laid` has to outlive the result.
/// `ends`: as find_end_points() finds them for it.
template <typename Scalar>
[[nodiscard]] PlacedJoints<Scalar>
place_joints(const Body<Scalar>& body, const curve::CurveResult<Scalar>& curve, const embedding::LaidTemplate& laid,
             const std::vector<refinement::EndPoint<Scalar>>& ends, const ExtractOptions& options = {});

/// The joints of a body at rest that was laid into the surface (rest_fit.hpp): those at the ends of the limbs by
/// cross-sections and anatomy along what the fit shows, the others, where figures show no cross-section, as the fit has
/// them.
template <typename Scalar>
[[nodiscard]] PlacedJoints<Scalar> place_joints(const Body<Scalar>& body, const RestFit<Scalar>& fit,
                                                const ExtractOptions& options = {});

/// The joints of a body in any pose that was laid into the surface (posed_fit.hpp), as the fit has them: along it
/// cross-sections place them worse. `diameter`: the largest geodesic distance on the body.
template <typename Scalar>
[[nodiscard]] PlacedJoints<Scalar> place_joints(const Body<Scalar>& body, const PosedFit& fit, Scalar diameter);

/// From placed joints on: sides told apart, the skeleton completed, its evidence. The curve serves as the middle that
/// joints come inside towards. \returns failure flat_trunk where trunk or hips have no extent.
template <typename Scalar>
[[nodiscard]] Outcome<Candidate<Scalar>> skeleton_of(const Body<Scalar>& body, const curve::CurveResult<Scalar>& curve,
                                                     const PlacedJoints<Scalar>& placed);

/// What LF20's Fig. 1 shows from the embedding on: place_joints() and the rest. A pure function: no other
/// curve, template or surface is tried. `laid`: the template in the curve. \returns failure too_compact for a curve
/// that is a point, flat_trunk where trunk or hips have no extent.
template <typename Scalar>
[[nodiscard]] Outcome<Candidate<Scalar>> skeleton_of(const Body<Scalar>& body, const curve::CurveResult<Scalar>& curve,
                                                     const embedding::LaidTemplate& laid,
                                                     const ExtractOptions& options = {});

/// The same with the template laid into the curve: the paper's straight line from a body and its curve to its skeleton.
/// \returns the failure of embed, too. \throws Error usage when an option is out of its range, bad_input when the
/// template breaks a rule.
template <typename Scalar>
[[nodiscard]] Outcome<Candidate<Scalar>> skeleton_of(const Body<Scalar>& body, const curve::CurveResult<Scalar>& curve,
                                                     const SkeletonTemplate& skeleton_template,
                                                     const ExtractOptions& options = {});

} // namespace skelgen::search

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/search/impl/line.hpp>
#endif
