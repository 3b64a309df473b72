#pragma once

#include <skelgen/fitting/best_surface.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>

#include <skelgen/anatomy/confidence.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/parallel.hpp>
#include <skelgen/core/precision.hpp>
#include <skelgen/core/stopwatch.hpp>
#include <skelgen/embedding/loop_cuts.hpp>
#include <skelgen/fitting/fit.hpp>
#include <skelgen/fitting/held_things.hpp>
#include <skelgen/fitting/partial_body.hpp>
#include <skelgen/fitting/shape_gates.hpp>
#include <skelgen/fitting/trust.hpp>
#include <skelgen/surface/open_handles.hpp>
#include <skelgen/surface/pockets.hpp>

namespace skelgen::fitting {

namespace detail {

/// How far a body's vertices have been moved off the input's by smoothing: the root mean square, part of its size.
template <typename Scalar>
double smoothed_away(const Body<Scalar>& body, const TriangleMesh<Scalar>& mesh) {
    core::Accumulator sum = 0;
    std::size_t count = 0;
    for (std::size_t v = 0; v < body.source.size(); ++v) {
        if (body.source[v] < 0) continue;
        const auto row = static_cast<Eigen::Index>(v);
        sum += (body.similarity.to_canonical(core::point(mesh.vertices, body.source[v])) -
                core::point(body.mesh.vertices, row))
                   .squaredNorm();
        ++count;
    }
    const double size = static_cast<double>(core::bounding_diagonal(body.mesh.vertices));
    return count > 0 && size > 0 ? std::sqrt(static_cast<double>(sum) / static_cast<double>(count)) / size : 0;
}

inline std::string noise_smoothed(double noise) {
    const auto tenths = static_cast<int>(std::lround(1000 * noise)); // of a per cent
    return "noise smoothed away: " + std::to_string(tenths / 10) + "." + std::to_string(tenths % 10) + " % of the size";
}

/// How sure a skeleton is: of its sides, but less for every joint that looks misplaced.
template <typename Scalar>
double sureness(const KinematicSkeleton<Scalar>& skeleton) {
    const auto misplaced =
        std::count_if(skeleton.joints.begin(), skeleton.joints.end(), [](const Joint<Scalar>& joint) {
            return joint.is_present && joint.confidence < anatomy::unlikely;
        });
    return skeleton.quality.sides_confidence / static_cast<double>(1 + misplaced);
}

/// A skeleton that is no surer than this is looked for in other ways, too.
inline constexpr double doubtful = 0.5;

template <typename Scalar>
bool is_sure(const Outcome<Fit<Scalar>>& found) {
    return found && sureness(found->skeleton) >= doubtful;
}

/// What was found, with so many milliseconds more that finding a curve that serves has taken.
template <typename Scalar>
Outcome<Fit<Scalar>> with_curve_time(Outcome<Fit<Scalar>> found, double curve_time) {
    if (found) found->timings.curve += curve_time;
    return found;
}

/// The template in the curve of a body.
template <typename Scalar>
struct FitToCurve {
    curve::CurveResult<Scalar> curve;
    Outcome<Fit<Scalar>> fit;
};

template <typename Scalar>
FitToCurve<Scalar> fit_to_own_curve(const Body<Scalar>& body, const SkeletonTemplate& wanted,
                                    const ExtractOptions& options, int attempts) {
    core::Stopwatch stage;
    curve::CurveResult<Scalar> curve = find_curve(body, options.curve);
    const double curve_time = stage.lap();
    Outcome<Fit<Scalar>> found = with_curve_time(fit(body, curve, wanted, options, attempts), curve_time);
    return {std::move(curve), std::move(found)};
}

/// The template in the draft of a body's curve. That of an envelope, whose pieces grow together where they lie close,
/// is not cut open: made whole and cut in all ways it takes as long as the curve itself, and hardly ever spares that.
template <typename Scalar>
FitToCurve<Scalar> fit_to_draft(const Body<Scalar>& body, const SkeletonTemplate& wanted, const ExtractOptions& options,
                                bool is_envelope) {
    core::Stopwatch stage;
    curve::CurveResult<Scalar> draft = find_curve(body, options.curve);
    const double curve_time = stage.lap();
    if (is_envelope && embedding::contact_count(draft.curve) > 0)
        return {std::move(draft), Failure{FailureReason::no_match, "the body touches itself"}};
    Outcome<Fit<Scalar>> found = with_curve_time(fit(body, draft, wanted, options, 1), curve_time);
    return {std::move(draft), std::move(found)};
}

/// The template in a curve of a body that is found quickly, or, where it is not found there or hardly, in its curve;
/// and where not there either, without what the body holds in its hands, if that is much surer.
template <typename Scalar>
Outcome<Fit<Scalar>> fit_whole(const Body<Scalar>& body, const SkeletonTemplate& wanted, const ExtractOptions& options,
                               int attempts, bool is_envelope) {
    core::Stopwatch stage;
    if (auto first = fit_to_draft(body, wanted, for_first_try(options), is_envelope);
        first.curve.is_point || is_sure(first.fit))
        return std::move(first.fit);
    const double first_time = stage.lap();
    auto [curve, found] = fit_to_own_curve(body, wanted, options, attempts);
    found = with_curve_time(std::move(found), first_time);
    if (curve.is_point || is_sure(found)) return std::move(found);
    const double curve_time = first_time + stage.lap();
    double sure = found ? sureness(found->skeleton) : 0;
    bool is_bare = false;
    for (const Body<Scalar>& bare : without_held_things(body, curve.curve, wanted, options.matching)) {
        Outcome<Fit<Scalar>> other =
            with_curve_time(fit(bare, find_curve(bare, options.curve), wanted, options, 1), curve_time);
        if (!other || trust_without_held_things * sureness(other->skeleton) <= sure) continue;
        if (is_bare && !is_sure(other)) continue; // what passes for fingers shows nothing else
        is_bare = true;
        sure = sureness(other->skeleton);
        other->skeleton = less_certain(std::move(other->skeleton), trust_without_held_things);
        found = std::move(other);
        if (sure >= doubtful) break;
    }
    return std::move(found);
}

/// The same for a body whose pockets are closed, opened where it has grown together with itself; an envelope, whose
/// pieces grow together where they lie close, is opened where it certainly has if that does not fit. Where the template
/// fits no such one, for the body as it is, but for an envelope that was only opened.
template <typename Scalar>
Outcome<Fit<Scalar>> fit_opened(const Body<Scalar>& given, const SkeletonTemplate& wanted,
                                const ExtractOptions& options, int attempts, bool is_envelope) {
    core::Stopwatch stage;
    const std::optional<Body<Scalar>> closed = surface::close_pockets(given);
    const Body<Scalar>& body = closed ? *closed : given;
    const std::optional<surface::OpenedBody<Scalar>> opened = surface::open_handles(body);
    const double opening = stage.lap();
    Outcome<Fit<Scalar>> found = fit_whole(opened ? opened->body : body, wanted, options, attempts, is_envelope);
    if (found && opened) found->skeleton = less_certain(std::move(found->skeleton), trust_in_grown_together);
    if (!found && opened && opened->before_creases && is_envelope && !is_refused(found)) {
        if (const auto less_opened = surface::open_short_handles(body, *opened))
            found = fit_whole(less_opened->body, wanted, options, 1, is_envelope);
        if (found) found->skeleton = less_certain(std::move(found->skeleton), trust_in_grown_together);
    }
    const bool may_fit_as_given = closed || (opened && !is_envelope && !is_refused(found));
    if (!found && may_fit_as_given) found = fit_whole(given, wanted, options, closed ? attempts : 1, is_envelope);
    if (found) found->timings.surface += opening;
    return found;
}

inline bool is_envelope(surface::Remedy remedy) {
    return remedy == surface::Remedy::envelope || remedy == surface::Remedy::wrap;
}

/// A skeleton found in a body that the remedy made of the mesh, with what that says of its certainty.
template <typename Scalar>
Outcome<Fit<Scalar>> judged_by_surface(Outcome<Fit<Scalar>> found, const Body<Scalar>& body, surface::Remedy remedy,
                                       double noise) {
    constexpr double much_noise = 0.005; // a centimetre on a person
    if (!found) return found;
    const bool is_noisy = noise > much_noise;
    if (is_noisy) found->skeleton.quality.warnings.push_back(noise_smoothed(noise));
    const bool is_as_given = remedy == surface::Remedy::largest_piece && body.dropped_pieces == 0 && !is_noisy;
    if (!is_as_given) found->skeleton = less_certain(std::move(found->skeleton), trust_in_repaired);
    return found;
}

/// What the remedies tried so far have led to.
template <typename Scalar>
struct Trials {
    std::optional<Outcome<Fit<Scalar>>> best; ///< where none has served, the first one's failure
    Body<Scalar> best_body;
    std::optional<std::pair<Body<Scalar>, surface::Remedy>> first_failed; ///< the surface, and what made it
    StageTimings timings;
};

/// The surface that a remedy makes of the material: a failure, too, where it is too compact for a body.
template <typename Scalar>
Outcome<Body<Scalar>> slender_body_by(surface::Remedy remedy, surface::BodyMaterial<Scalar> material,
                                      const surface::PrepareOptions& options) {
    Outcome<Body<Scalar>> body = surface::make_body_by(remedy, std::move(material), options);
    if (body && is_envelope(remedy))
        if (const auto failure = too_compact(*body)) return *failure;
    return body;
}

/// Fits the template to the surface that a remedy makes. \returns whether other remedies need not be tried.
template <typename Scalar>
bool try_remedy(surface::Remedy remedy, surface::BodyMaterial<Scalar> material, const TriangleMesh<Scalar>& mesh,
                const SkeletonTemplate& wanted, const ExtractOptions& options, Trials<Scalar>& trials) {
    constexpr double sure = 0.4;
    auto& [best, best_body, first_failed, timings] = trials;
    if (remedy == surface::Remedy::rounded && best && is_refused(*best)) return true; // however round
    // What is wrong with one of several surfaces is not the curve's doing: the next surface may serve better.
    const surface::Remedy last = material.remedies.back();
    const bool is_only_one = last == material.remedies.front() || last == surface::Remedy::rounded;
    core::Stopwatch stage;
    Outcome<Body<Scalar>> body = slender_body_by(remedy, std::move(material), options.prepare);
    timings.surface += stage.lap();
    if (!body) {
        if (!best) best = body.failure();
        return false;
    }
    std::optional<Outcome<Fit<Scalar>>> fitted;
    double noise = 0;
    core::in_parallel(
        [&] { fitted = fit_opened(*body, wanted, options, is_only_one ? most_attempts : 1, is_envelope(remedy)); },
        [&] { noise = smoothed_away(*body, mesh); });
    Outcome<Fit<Scalar>>& found = *fitted;
    if (found) timings = timings + found->timings;
    found = judged_by_surface(std::move(found), *body, remedy, noise);
    // What is thin where gaps are open is no body where they are closed: that takes long on boards and bars.
    const bool is_too_long = is_envelope(remedy) && !found && found.failure().reason == FailureReason::too_long;
    if (!found && !first_failed) first_failed = std::pair(*body, remedy);
    const bool better = found && (!best || !*best || sureness(found->skeleton) > sureness((*best)->skeleton));
    if (better || !best) {
        best = std::move(found);
        best_body = *std::move(body);
    }
    return is_too_long || (*best && sureness((*best)->skeleton) >= sure);
}

/// Where no surface has a whole skeleton, that of the first of them as one that lacks a limb.
template <typename Scalar>
void try_partial(const TriangleMesh<Scalar>& mesh, const SkeletonTemplate& wanted, const ExtractOptions& options,
                 Trials<Scalar>& trials) {
    auto& [body, remedy] = *trials.first_failed;
    Outcome<Fit<Scalar>> partial = fit_partial(body, wanted, options);
    if (!partial) return;
    trials.timings = trials.timings + partial->timings;
    trials.best = judged_by_surface(std::move(partial), body, remedy, smoothed_away(body, mesh));
    trials.best_body = std::move(body);
}

} // namespace detail

template <typename Scalar>
Outcome<FittedBody<Scalar>> fit_to_best_surface(const TriangleMesh<Scalar>& mesh, const SkeletonTemplate& wanted,
                                                const ExtractOptions& options) {
    core::Stopwatch stage;
    surface::BodyMaterial<Scalar> material = surface::gather(mesh, options.prepare);
    if (material.bodies > 1 && options.prepare.component == 0)
        return Failure{FailureReason::no_body,
                       std::to_string(material.bodies) +
                           " bodies apart; give each a file of its own, or take one by its number (--component)"};
    detail::Trials<Scalar> trials;
    trials.timings.surface = stage.lap();
    const std::vector<surface::Remedy> remedies = material.remedies;
    for (const surface::Remedy remedy : remedies) {
        const bool is_last = remedy == remedies.back();
        if (detail::try_remedy(remedy, is_last ? std::move(material) : material, mesh, wanted, options, trials)) break;
    }
    Outcome<Fit<Scalar>>& best = *trials.best;
    if (!best && !is_refused(best) && trials.first_failed) detail::try_partial(mesh, wanted, options, trials);
    if (!best) return best.failure();
    best->timings = trials.timings;
    return FittedBody<Scalar>{*std::move(best), std::move(trials.best_body)};
}

} // namespace skelgen::fitting
