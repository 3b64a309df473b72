#pragma once

#include <skelgen/fitting/attempt.hpp>

#include <algorithm>
#include <utility>
#include <vector>

#include <skelgen/anatomy/complete.hpp>
#include <skelgen/anatomy/confidence.hpp>
#include <skelgen/core/header_only.hpp>
#include <skelgen/core/stopwatch.hpp>
#include <skelgen/embedding/embed.hpp>
#include <skelgen/embedding/missing_limbs.hpp>
#include <skelgen/embedding/proportions.hpp>
#include <skelgen/fitting/shape_gates.hpp>
#include <skelgen/fitting/trust.hpp>
#include <skelgen/refinement/end_points.hpp>

namespace skelgen::fitting {

SKELGEN_INLINE std::string part_name(JointRole end) {
    return end == JointRole::head          ? "its head"
           : part_of(end) == BodyPart::arm ? "an arm or part of it"
                                           : "a leg or part of it";
}

template <typename Scalar>
Attempt<Scalar> fit_to_curve(const Body<Scalar>& body, const curve::CurveResult<Scalar>& found,
                             const SkeletonTemplate& given, const ExtractOptions& options) {
    constexpr double trust_in_odd = 0.5; // as animals may have such proportions, too: a working value
    const CurveSkeleton<Scalar>& curve = found.curve;
    core::Stopwatch stage;
    StageTimings timings;
    const auto failed = [&](const Failure& failure) { return Attempt<Scalar>{failure, timings}; };
    if (found.is_point) return failed(too_compact_a_shape());

    const embedding::FittingTemplate fitting = embedding::fitting_proportions(curve, given, options.matching);
    const SkeletonTemplate& wanted = fitting.skeleton_template;
    const Outcome<embedding::Embedding> embedding = embedding::embed(curve, wanted, options.matching);
    if (!embedding) return failed(embedding.failure());
    if (const auto failure = not_single(curve, *embedding)) return failed(*failure);
    const Scalar unmatched = embedding::unmatched_share(curve, *embedding);
    if (const auto failure = not_all_matched(unmatched)) return failed(*failure);
    if (const auto lacking = embedding::find_missing_limb(curve, wanted, *embedding, options.matching))
        return failed({FailureReason::no_match,
                       "no whole human body: it seems to lack " + part_name(wanted.joint(lacking->end).role)});
    timings.embed = stage.lap();

    const auto ends = refinement::find_end_points(body, curve, *embedding, wanted);
    const Scalar diameter = refinement::geodesic_diameter(ends);
    const auto failure_of_shape = not_slender(diameter, fitting.is_odd ? least_of_figures : least_of_adults);
    const bool is_folded = failure_of_shape && is_folded_body(curve, *embedding, unmatched);
    const bool is_stout_figure = failure_of_shape && !is_folded && embedding::legs_go_on(curve, *embedding, wanted);
    if (is_stout_figure) {
        if (const auto failure = not_slender(diameter, least_of_standing_figures)) return failed(*failure);
    } else if (failure_of_shape && !is_folded) {
        return failed(*failure_of_shape);
    }
    const auto joints = refinement::refine(body, ends, curve, *embedding, wanted, options.refinement);
    timings.refine = stage.lap();

    const bool is_figure = fitting.is_odd || is_stout_figure;
    const auto sides =
        symmetry::decide_sides(joints, wanted, is_figure ? symmetry::sides_of_figures(options.sides) : options.sides);
    if (!sides) return failed(sides.failure());
    auto completed = anatomy::complete_skeleton(symmetry::assemble(joints, wanted, *sides), body, curve, wanted);
    timings.sides = stage.lap();
    if (!completed) return failed(completed.failure());
    if (const auto failure = not_apart(completed->skeleton, wanted)) return failed(*failure);
    completed->skeleton.quality.matched_nodes = embedding->matched_nodes;
    const double distortion = embedding::distortion_per_pair(*embedding);
    const double all_matched = 1 - std::min(static_cast<double>(unmatched), 1.0);
    const double fitted = distortion > well_fitted ? well_fitted / distortion : 1;
    completed->skeleton =
        less_certain(std::move(completed->skeleton), all_matched * fitted * (is_folded ? trust_in_grown_together : 1));
    if (is_figure) {
        completed->skeleton = less_certain(std::move(completed->skeleton), trust_in_odd);
        completed->skeleton.quality.warnings.push_back("unusual proportions: it may be none of a human body");
    }
    if (!embedding->is_least)
        completed->skeleton.quality.warnings.push_back(
            "the curve skeleton has too many branches to try all matches: limbs may be mistaken");
    return {Candidate<Scalar>{std::move(completed->skeleton), found, diameter, completed->misplaced}, timings};
}

template <typename Scalar>
Outcome<Fit<Scalar>> to_fit(const Body<Scalar>& body, Attempt<Scalar> attempt, const ExtractOptions& options) {
    if (!attempt.outcome) return attempt.outcome.failure();
    Candidate<Scalar>& found = *attempt.outcome;
    std::vector<std::string>& warnings = found.skeleton.quality.warnings;
    warnings.insert(warnings.end(), body.repairs.begin(), body.repairs.end());
    if (body.dropped_pieces > 0)
        warnings.push_back(std::to_string(body.dropped_pieces) + " pieces not connected to the body were left out");
    if (!found.curve.converged) warnings.push_back("the curve skeleton's contraction did not converge");
    found.skeleton = anatomy::no_surer_than_the_whole(std::move(found.skeleton));
    Fit<Scalar> out{
        surface::to_input(body, found.skeleton), {}, body.similarity.scale * found.geodesic_diameter, attempt.timings};
    if (!options.with_curve) return out;
    core::Stopwatch stage;
    out.curve = surface::to_input(body, curve::finished(std::move(found.curve), body).curve);
    out.timings.curve += stage.lap();
    return out;
}

} // namespace skelgen::fitting
