#pragma once

#include <skelgen/fitting/finer_curves.hpp>

#include <algorithm>
#include <optional>
#include <utility>

#include <skelgen/core/curve_graph.hpp>
#include <skelgen/core/stopwatch.hpp>
#include <skelgen/embedding/embed.hpp>
#include <skelgen/embedding/proportions.hpp>
#include <skelgen/fitting/shape_gates.hpp>

namespace skelgen::fitting {

namespace detail {

/// How much looks wrong with a skeleton: joints misplaced, and last a curve whose contraction did not converge.
template <typename Scalar>
std::pair<int, bool> faults(const Candidate<Scalar>& found) {
    return {found.misplaced, !found.curve.converged};
}

/// Where stout arms hang beside the trunk their own sections are few, and centring may draw their junctions down the
/// trunk: what the template does not fit well then, although nearly all of the curve is matched, is left as it was
/// after few rounds of that, if it fits well so.
template <typename Scalar>
std::optional<curve::CurveResult<Scalar>> less_centred(const Body<Scalar>& body,
                                                       const curve::CurveResult<Scalar>& given,
                                                       const SkeletonTemplate& wanted, const ExtractOptions& options) {
    constexpr int few = 3;                 // one coarse round, and two of those that join branches
    constexpr Scalar hardly = Scalar(0.1); // of the chains' length
    if (!given.contracted || given.is_draft || options.curve.centring.rounds <= few) return std::nullopt;
    const CurveSkeleton<Scalar>& curve = given.curve;
    const auto embedding = embedding::embed(curve, wanted, options.matching);
    if (!embedding || core::cycle_count(curve) > 0) return std::nullopt;
    const bool is_all_matched = embedding::unmatched_share(curve, *embedding) <= hardly;
    if (!is_all_matched && !embedding::legs_go_on(curve, *embedding, wanted)) return std::nullopt;
    if (!embedding::fitting_proportions(curve, wanted, options.matching).fits_badly) return std::nullopt;
    curve::CurveResult<Scalar> found = recentred(given, body, few);
    const bool fits = embedding::embed(found.curve, wanted, options.matching) &&
                      !embedding::fitting_proportions(found.curve, wanted, options.matching).fits_badly;
    return fits ? std::optional(std::move(found)) : std::nullopt;
}

} // namespace detail

template <typename Scalar>
Attempt<Scalar> fit_to_finer_curves(const Body<Scalar>& body, const curve::CurveResult<Scalar>& given,
                                    const SkeletonTemplate& wanted, const ExtractOptions& options, int attempts) {
    core::Stopwatch first;
    const auto less = detail::less_centred(body, given, wanted, options);
    const curve::CurveResult<Scalar>& curve = less ? *less : given;
    const double more_curves = first.lap();
    Attempt<Scalar> best = fit_to_curve(body, curve, wanted, options);
    best.timings.curve += more_curves;
    curve::CurveOptions finer = options.curve;
    for (int attempt = 1; attempt < attempts; ++attempt) {
        const bool good = best.outcome && best.outcome->misplaced < suspicious && best.outcome->curve.converged;
        if (good || is_refused(best.outcome)) break;
        core::Stopwatch stage;
        finer.proxy.vertices = std::min(finer.proxy.vertices + finer.proxy.vertices / 2, curve::most_proxy_vertices);
        const curve::CurveResult<Scalar> finer_curve = find_curve(body, finer);
        StageTimings timings = best.timings;
        timings.curve += stage.lap();
        Attempt<Scalar> next = fit_to_curve(body, finer_curve, wanted, options);
        timings = timings + next.timings;
        const bool refused = is_refused(next.outcome);
        const bool better =
            next.outcome && (!best.outcome || detail::faults(*next.outcome) < detail::faults(*best.outcome));
        if (refused || better) best = std::move(next);
        best.timings = timings;
    }
    return best;
}

} // namespace skelgen::fitting
