#pragma once

#include <skelgen/fitting/partial_body.hpp>

#include <algorithm>
#include <limits>
#include <utility>

#include <skelgen/core/stopwatch.hpp>
#include <skelgen/embedding/embed.hpp>
#include <skelgen/embedding/missing_limbs.hpp>
#include <skelgen/fitting/finer_curves.hpp>
#include <skelgen/fitting/shape_gates.hpp>
#include <skelgen/fitting/trust.hpp>

namespace skelgen::fitting {

namespace detail {

/// How far a skeleton without a limb can be trusted: less than a whole one, as the limb may be there and lie on the
/// body; without a head, little: it may as well be the clothes of one. Working values; so measured, none is wrong with
/// confidence above 0.8.
inline double trust_without(JointRole end) { return end == JointRole::head ? 0.45 : 0.75; }

/// A body as one that lacks a limb.
template <typename Scalar>
struct PartialAttempt {
    Attempt<Scalar> attempt;
    double least_distortion; ///< per pair, of all templates without a limb: see embedding::distortion_per_pair
};

/// How badly a template without a limb fits: its distortion, twice that where an arm's length of the curve is left
/// over. What is left of a limb is its stump, and the longer, the more of the limb is there.
template <typename Scalar>
double misfit_of_part(const CurveSkeleton<Scalar>& curve, const embedding::Embedding& part) {
    const Scalar left_over = embedding::unmatched_reach(curve, part) / arm_of_curve<Scalar>;
    return embedding::distortion_per_pair(part) * (1 + static_cast<double>(left_over));
}

/// The template without a limb that fits the curve best, if it fits well.
template <typename Scalar>
PartialAttempt<Scalar> fit_part_to_curve(const Body<Scalar>& body, const curve::CurveResult<Scalar>& found,
                                         const SkeletonTemplate& wanted, const ExtractOptions& options) {
    Attempt<Scalar> best{Failure{FailureReason::no_match, "no human body, nor one that lacks a limb"}, {}};
    double least = std::numeric_limits<double>::infinity(), least_of_all = least;
    for (const embedding::PartialTemplate& part : embedding::partial_templates(wanted)) {
        const auto embedding = embedding::embed(found.curve, part.skeleton_template, options.matching);
        if (!embedding) continue;
        const double distortion = embedding::distortion_per_pair(*embedding);
        least_of_all = std::min(least_of_all, distortion);
        const double misfit = misfit_of_part(found.curve, *embedding);
        if (!(distortion < well_fitted && misfit < least)) continue;
        Attempt<Scalar> attempt = fit_to_curve(body, found, part.skeleton_template, options);
        attempt.timings = attempt.timings + best.timings;
        if (!attempt.outcome || attempt.outcome->misplaced >= suspicious) continue;
        least = misfit;
        best = std::move(attempt);
        const JointRole end = wanted.joint(part.end).role;
        best.outcome->skeleton = less_certain(std::move(best.outcome->skeleton), trust_without(end));
        best.outcome->skeleton.quality.warnings.push_back("the body seems to lack " + part_name(end));
    }
    return {std::move(best), least_of_all};
}

} // namespace detail

template <typename Scalar>
Outcome<Fit<Scalar>> fit_partial(const Body<Scalar>& body, const SkeletonTemplate& wanted,
                                 const ExtractOptions& options) {
    constexpr double nearly = 2; // times the distortion of what fits well
    curve::CurveOptions finer = options.curve;
    StageTimings timings;
    for (int i = 0; i < most_attempts; ++i) {
        core::Stopwatch stage;
        const curve::CurveResult<Scalar> curve = find_curve(body, finer);
        timings.curve += stage.lap();
        auto [attempt, least_distortion] = detail::fit_part_to_curve(body, curve, wanted, options);
        timings = timings + attempt.timings;
        attempt.timings = timings;
        if (attempt.outcome) return to_fit(body, std::move(attempt), options);
        if (least_distortion > nearly * well_fitted) break;
        finer.proxy.vertices = std::min(finer.proxy.vertices + finer.proxy.vertices / 2, curve::most_proxy_vertices);
    }
    return Failure{FailureReason::no_match, "no human body, nor one that lacks a limb"};
}

} // namespace skelgen::fitting
