#pragma once

#include <skelgen/search/line.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include <skelgen/anatomy/complete.hpp>
#include <skelgen/core/geodesics.hpp>
#include <skelgen/core/stopwatch.hpp>
#include <skelgen/core/template_rules.hpp>
#include <skelgen/refinement/end_points.hpp>
#include <skelgen/refinement/refine.hpp>
#include <skelgen/search/trust.hpp>
#include <skelgen/symmetry/sides.hpp>

namespace skelgen::search {

namespace detail {

/// From placed joints on: sides, the completed skeleton, the evidence.
template <typename Scalar>
Outcome<Candidate<Scalar>> completed_candidate(const Body<Scalar>& body, const CurveSkeleton<Scalar>& curve,
                                               const refinement::RefinedJoints<Scalar>& joints,
                                               const embedding::Embedding* embedding, const SkeletonTemplate& wanted,
                                               Scalar diameter, const symmetry::SidesOptions& witnesses) {
    core::Stopwatch stage;
    const auto sides = symmetry::decide_sides(joints, wanted, witnesses);
    if (!sides) return sides.failure();
    auto completed = anatomy::complete_skeleton(symmetry::assemble(joints, wanted, *sides), body, curve, wanted);
    Candidate<Scalar> out;
    out.geodesic_diameter = diameter;
    out.evidence = evidence_of(body, curve, embedding, completed, wanted, diameter);
    out.probability = probability_right(out.evidence);
    out.skeleton = std::move(completed.skeleton);
    out.doubt = std::move(completed.doubt);
    out.timings.sides = stage.lap();
    return out;
}

} // namespace detail

template <typename Scalar>
Outcome<Candidate<Scalar>> skeleton_of(const Body<Scalar>& body, const curve::CurveResult<Scalar>& found,
                                       const embedding::FittingTemplate& laid, const ExtractOptions& options) {
    if (found.is_point)
        return Failure{Refusal::too_compact, "no human body: too compact a shape for one with arms and legs"};
    const auto& [wanted, embedding, is_odd, fits_badly] = laid;
    core::Stopwatch stage;
    const auto ends = refinement::find_end_points(body, found.curve, embedding, wanted);
    const auto joints = refinement::refine(body, ends, found.curve, embedding, wanted, options.refinement);
    const double refine_time = stage.lap();
    auto out =
        detail::completed_candidate(body, found.curve, joints, &embedding, wanted, refinement::geodesic_diameter(ends),
                                    is_odd ? symmetry::sides_of_figures(options.sides) : options.sides);
    if (!out) return out;
    out->timings.refine = refine_time;
    out->skeleton.quality.matched_nodes = embedding.matched_nodes;
    if (!embedding.is_least)
        out->skeleton.quality.warnings.push_back(
            "the curve skeleton has too many branches to try all matches: limbs may be mistaken");
    return out;
}

template <typename Scalar>
Outcome<Candidate<Scalar>> skeleton_of(const Body<Scalar>& body, const curve::CurveResult<Scalar>& found,
                                       const RestFit<Scalar>& fit, const ExtractOptions& options) {
    auto out = detail::completed_candidate<Scalar>(body, found.curve, fit.joints, nullptr, fit.skeleton_template,
                                                   core::geodesic_diameter(body.graph),
                                                   symmetry::sides_of_figures(options.sides));
    if (!out) return out;
    out->evidence[Witness::fitted] = 1;
    out->evidence[Witness::fit_cost] = std::log(std::max(fit.cost, 1e-3));
    out->probability = probability_right(out->evidence);
    return out;
}

template <typename Scalar>
Outcome<Candidate<Scalar>> skeleton_of(const Body<Scalar>& body, const curve::CurveResult<Scalar>& found,
                                       const SkeletonTemplate& skeleton_template, const ExtractOptions& options) {
    validate(options);
    validate_template(skeleton_template);
    core::Stopwatch stage;
    const auto laid = embedding::fitting_proportions(found.curve, skeleton_template, options.matching);
    if (!laid && !found.is_point) return laid.failure();
    const double embedding_time = stage.lap();
    auto out = skeleton_of(body, found, laid ? *laid : embedding::FittingTemplate{}, options);
    if (out) out->timings.embed = embedding_time;
    return out;
}

} // namespace skelgen::search
