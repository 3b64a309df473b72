#pragma once

#include <skelgen/fitting/touching_body.hpp>

#include <optional>
#include <string>
#include <utility>

#include <skelgen/anatomy/confidence.hpp>
#include <skelgen/core/stopwatch.hpp>
#include <skelgen/embedding/embed.hpp>
#include <skelgen/embedding/loop_cuts.hpp>
#include <skelgen/embedding/part_contacts.hpp>
#include <skelgen/fitting/finer_curves.hpp>
#include <skelgen/fitting/shape_gates.hpp>
#include <skelgen/fitting/trust.hpp>

namespace skelgen::fitting {

namespace detail {

/// Where limbs touch, the surface may have been cut in the wrong place, and uncut, the curve runs on from one limb to
/// the other: so much less can the skeleton be trusted. Calibrated on generated bodies that touch themselves.
template <typename Scalar>
KinematicSkeleton<Scalar> less_certain_for_contacts(KinematicSkeleton<Scalar> skeleton, int contacts, bool cut) {
    skeleton = less_certain(std::move(skeleton), cut ? 0.75 : 0.7);
    skeleton.quality.warnings.push_back("the body touches itself in " + std::to_string(contacts) +
                                        (contacts == 1 ? " place" : " places") +
                                        (cut ? ": it was cut there" : ": limbs may be mistaken"));
    return skeleton;
}

} // namespace detail

template <typename Scalar>
Outcome<Fit<Scalar>> fit_touching_body(const Body<Scalar>& body, const curve::CurveResult<Scalar>& found,
                                       const SkeletonTemplate& wanted, const ExtractOptions& options, int attempts) {
    const CurveSkeleton<Scalar>& curve = found.curve;
    // Two bodies that touch are refused first: cutting them apart would hide that there are two.
    if (const auto embedding = embedding::embed(curve, wanted, options.matching))
        if (const auto failure = not_single(curve, *embedding)) return *failure;

    core::Stopwatch stage;
    const int contacts = embedding::contact_count(curve);
    const auto ways = embedding::part_contacts(body, curve, wanted, options.matching, options.curve);
    StageTimings cutting;
    cutting.curve = stage.lap();
    const auto finish = [&](const Body<Scalar>& fitted_body, Attempt<Scalar> attempt, bool cut) {
        if (attempt.outcome)
            attempt.outcome->skeleton =
                detail::less_certain_for_contacts(std::move(attempt.outcome->skeleton), contacts, cut);
        attempt.timings = attempt.timings + cutting;
        return to_fit(fitted_body, std::move(attempt), options);
    };
    std::optional<Attempt<Scalar>> best;
    const embedding::PartedBody<Scalar>* best_way = nullptr;
    const int attempts_each = ways.size() > 1 ? 1 : attempts; // another way is another attempt
    for (const embedding::PartedBody<Scalar>& way : ways) {
        Attempt<Scalar> attempt = fit_to_finer_curves(way.body, way.curve, wanted, options, attempts_each);
        cutting = cutting + attempt.timings;
        if (!attempt.outcome) continue;
        if (best && !(mean_confidence(attempt.outcome->skeleton) > mean_confidence(best->outcome->skeleton))) continue;
        best = std::move(attempt);
        best_way = &way;
    }
    if (best) {
        best->timings = {}; // counted
        Outcome<Fit<Scalar>> apart = finish(best_way->body, *std::move(best), true);
        // What is a body only once it is cut apart, and looks misplaced as a whole then, may be furniture.
        if (apart && mean_confidence(apart->skeleton) >= anatomy::unlikely) return apart;
    }
    return finish(body, fit_to_finer_curves(body, found, wanted, options, attempts), false);
}

} // namespace skelgen::fitting
