#pragma once

#include <skelgen/extract.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <skelgen/anatomy/complete.hpp>
#include <skelgen/anatomy/confidence.hpp>
#include <skelgen/core/curve_graph.hpp>
#include <skelgen/core/error.hpp>
#include <skelgen/core/geodesics.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/header_only.hpp>
#include <skelgen/core/template_rules.hpp>
#include <skelgen/embedding/embed.hpp>
#include <skelgen/embedding/loop_cuts.hpp>
#include <skelgen/embedding/missing_limbs.hpp>
#include <skelgen/embedding/part_contacts.hpp>
#include <skelgen/embedding/proportions.hpp>
#include <skelgen/refinement/end_points.hpp>
#include <skelgen/surface/canonical_form.hpp>
#include <skelgen/surface/manifold_parts.hpp>
#include <skelgen/surface/open_handles.hpp>

namespace skelgen {
namespace detail {

class Stopwatch {
public:
    /// Milliseconds since the last lap.
    double lap() {
        const auto now = std::chrono::steady_clock::now();
        const double elapsed = std::chrono::duration<double, std::milli>(now - last_).count();
        last_ = now;
        return elapsed;
    }

private:
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

inline StageTimings operator+(const StageTimings& a, const StageTimings& b) {
    return {a.surface + b.surface, a.curve + b.curve, a.embed + b.embed,
            a.refine + b.refine,   a.sides + b.sides, a.total + b.total};
}

inline Failure too_compact_a_shape() {
    return {FailureReason::no_body, "no human body: too compact a shape for one with arms and legs"};
}

inline Failure too_long_a_shape() {
    return {FailureReason::no_body, "no single human body: too thin and long a shape for one"};
}

/// A body reaches far for its surface: toe to fingertip takes 1.34 (very heavy, or in a coat) to 1.85 times (thin) the
/// square root of its area, drawn figures with large heads and short limbs 1.2; a ball 0.9, a toy koala 1, a dog 1.2,
/// two people hand in hand 2.2: measured on registered and generated bodies, figures and objects. `diameter` is
/// geodesic, for unit area; `is_figure`: a drawn figure's proportions fit, and an adult's do not.
template <typename Scalar>
std::optional<Failure> not_slender(Scalar diameter, bool is_figure) {
    constexpr Scalar least = Scalar(1.26), least_of_figures = Scalar(1.15), most = Scalar(2.1);
    if (diameter < (is_figure ? least_of_figures : least)) return too_compact_a_shape();
    if (diameter > most) return too_long_a_shape();
    return std::nullopt;
}

/// A heavy body whose hands lie on it still reaches from head to toe, 1.05 times the square root of its area: what does
/// not is known to be none before its curve is looked for, which takes much longer.
template <typename Scalar>
std::optional<Failure> too_compact(const Body<Scalar>& body) {
    constexpr Scalar least = Scalar(1.05), estimated = Scalar(0.95); // the latter of the diameter, at least
    const Scalar most = core::geodesic_diameter(body.graph) / estimated;
    return most < least ? std::optional(too_compact_a_shape()) : std::nullopt;
}

/// So little distorted, per pair, the template is in whole bodies, and is to be without a limb in others: see
/// embedding::distortion_per_pair.
inline constexpr double well_fitted = 0.006;

/// Where a body has grown together with itself limbs may have been mistaken, wherever it was opened. So much less can
/// the skeleton be trusted: a working value, that of bodies which were cut.
inline constexpr double trust_in_grown_together = 0.75;

/// What folds up and has grown together with itself reaches less far over its surface, while the longest
/// way along its curve stays as long as a body's: 1.04 to 1.22 times its reach over the surface on registered
/// bodies, 1.08 on average. Only what the template fits well is taken for such a one.
template <typename Scalar>
bool is_folded_body(const CurveSkeleton<Scalar>& curve, const embedding::Embedding& embedding, Scalar unmatched) {
    constexpr Scalar longer = Scalar(1.08), most_unmatched = Scalar(0.1);
    return embedding::distortion_per_pair(embedding) < well_fitted && unmatched < most_unmatched &&
           !not_slender(embedding::matched_diameter(curve, embedding) / longer, false);
}

/// A person's arm, as a part of the curve: a sixth.
template <typename Scalar>
inline constexpr Scalar arm_of_curve = Scalar(0.17);

/// What goes on as far as a person's arm and belongs to no limb is another body's.
template <typename Scalar>
std::optional<Failure> not_single(const CurveSkeleton<Scalar>& curve, const embedding::Embedding& embedding) {
    if (embedding::unmatched_reach(curve, embedding) > arm_of_curve<Scalar>)
        return Failure{FailureReason::no_body,
                       "no single human body: a limb is left over; separate bodies that are joined to others"};
    return std::nullopt;
}

/// What belongs to no limb is no more than clothes, hair and weapons make. The skeleton is so much less certain as
/// there is of it. Calibrated on generated and real bodies, dressed ones among them (0.24 at most), and pairs of them.
template <typename Scalar>
std::optional<Failure> not_all_matched(Scalar unmatched) {
    constexpr auto most = Scalar(0.4);
    if (unmatched > most)
        return Failure{
            FailureReason::no_body,
            "no single human body: much of its curve skeleton belongs to no limb; separate what is joined to it"};
    return std::nullopt;
}

/// An arm below its shoulder or a leg below its hip, by role and side; all that the trunk has in one; none for what may
/// lie in either.
enum class MainPart { none, trunk, arm, leg };

inline MainPart main_part(JointRole role) {
    switch (role) {
    case JointRole::waist:
    case JointRole::chest:
    case JointRole::neck:
        return MainPart::trunk;
    case JointRole::elbow:
    case JointRole::wrist:
    case JointRole::hand:
        return MainPart::arm;
    case JointRole::knee:
    case JointRole::ankle:
    case JointRole::foot:
        return MainPart::leg;
    default:
        return MainPart::none;
    }
}

/// A joint of a limb in the midst of another limb, or of the trunk: the limb has been lost on the way to the curve.
/// Where limbs lie on each other their joints are farther from the other's bone than they are thick: 1.1 times the
/// radius at least on real bodies.
template <typename Scalar>
std::optional<Failure> not_apart(const KinematicSkeleton<Scalar>& skeleton, const SkeletonTemplate& wanted) {
    constexpr Scalar least = Scalar(0.8); // of the joint's radius
    const std::size_t count = wanted.joints.size();
    for (std::size_t j = 0; j < count; ++j) {
        const TemplateJoint& joint = wanted.joints[j];
        const MainPart limb = main_part(joint.role);
        if (limb != MainPart::arm && limb != MainPart::leg) continue;
        for (std::size_t k = 0; k < count; ++k) {
            const TemplateJoint& other = wanted.joints[k];
            const MainPart part = main_part(other.role);
            if (!skeleton.joints[j].is_present || !skeleton.joints[k].is_present) continue;
            if (part == MainPart::none || other.parent < 0 || (part == limb && other.side == joint.side)) continue;
            const Vector3<Scalar>& from = skeleton.joints[static_cast<std::size_t>(other.parent)].position;
            const Vector3<Scalar>& place = skeleton.joints[j].position;
            const auto nearest = core::nearest_on_segment<Scalar, 3>(place, from, skeleton.joints[k].position);
            if (nearest.distance < least * skeleton.joints[j].radius)
                return Failure{FailureReason::no_match,
                               "no human body: two limbs lie along one; check that all stand free"};
        }
    }
    return std::nullopt;
}

/// A skeleton in the body's coordinates, and how good it is.
template <typename Scalar>
struct Candidate {
    KinematicSkeleton<Scalar> skeleton;
    curve::CurveResult<Scalar> curve;
    Scalar geodesic_diameter = 0;
    int misplaced = 0; ///< joints whose bones have unlikely lengths
};

/// A skeleton that can be trusted no more than this part of what it is trusted otherwise.
template <typename Scalar>
KinematicSkeleton<Scalar> less_certain(KinematicSkeleton<Scalar> skeleton, double often_right) {
    skeleton.quality.sides_confidence *= often_right;
    for (Joint<Scalar>& joint : skeleton.joints) joint.confidence *= often_right;
    return skeleton;
}

/// What a body lacks that lacks the limb which ends in such a joint.
inline std::string part_name(JointRole end) {
    return end == JointRole::head          ? "its head"
           : part_of(end) == BodyPart::arm ? "an arm or part of it"
                                           : "a leg or part of it";
}

/// One attempt, with one curve: what LF20's Fig. 1 shows from the embedding on.
template <typename Scalar>
struct Attempt {
    Outcome<Candidate<Scalar>> outcome;
    StageTimings timings;
};

template <typename Scalar>
Attempt<Scalar> fit_to_curve(const Body<Scalar>& body, const curve::CurveResult<Scalar>& found,
                             const SkeletonTemplate& given, const ExtractOptions& options) {
    constexpr double trust_in_odd = 0.5; // as animals may have such proportions, too: a working value
    const CurveSkeleton<Scalar>& curve = found.curve;
    Stopwatch stage;
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
    const auto failure_of_shape = not_slender(diameter, fitting.is_odd);
    const bool is_folded = failure_of_shape && is_folded_body(curve, *embedding, unmatched);
    if (failure_of_shape && !is_folded) return failed(*failure_of_shape);
    const auto joints = refinement::refine(body, ends, curve, *embedding, wanted, options.refinement);
    timings.refine = stage.lap();

    const auto sides = symmetry::decide_sides(joints, wanted, options.sides);
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
    if (fitting.is_odd) {
        completed->skeleton = less_certain(std::move(completed->skeleton), trust_in_odd);
        completed->skeleton.quality.warnings.push_back("unusual proportions: it may be none of a human body");
    }
    if (!embedding->is_least)
        completed->skeleton.quality.warnings.push_back(
            "the curve skeleton has too many branches to try all matches: limbs may be mistaken");
    return {Candidate<Scalar>{std::move(completed->skeleton), found, diameter, completed->misplaced}, timings};
}

/// How much looks wrong with a skeleton: joints misplaced, and last a curve whose contraction did not converge.
template <typename Scalar>
std::pair<int, bool> faults(const Candidate<Scalar>& found) {
    return {found.misplaced, !found.curve.converged};
}

inline constexpr int most_attempts = 3;

/// So many misplaced joints make a skeleton doubtful.
inline constexpr int suspicious = 3;

/// Where stout arms hang beside the trunk their own sections are few, and centring may draw their junctions down the
/// trunk: what the template does not fit well then, although nearly all of the curve is matched, is left as it was
/// after few rounds of that, if it fits well so.
template <typename Scalar>
std::optional<curve::CurveResult<Scalar>> less_centred(const Body<Scalar>& body, const CurveSkeleton<Scalar>& curve,
                                                       const SkeletonTemplate& wanted, const ExtractOptions& options) {
    constexpr int few = 3;                 // one coarse round, and two of those that join branches
    constexpr Scalar hardly = Scalar(0.1); // of the chains' length
    const auto embedding = embedding::embed(curve, wanted, options.matching);
    if (options.curve.centring.rounds <= few || !embedding || core::cycle_count(curve) > 0) return std::nullopt;
    if (embedding::unmatched_share(curve, *embedding) > hardly) return std::nullopt;
    if (!embedding::fitting_proportions(curve, wanted, options.matching).fits_badly) return std::nullopt;
    curve::CurveOptions less = options.curve;
    less.centring.rounds = few;
    curve::CurveResult<Scalar> found = find_curve(body, less);
    const bool fits = embedding::embed(found.curve, wanted, options.matching) &&
                      !embedding::fitting_proportions(found.curve, wanted, options.matching).fits_badly;
    return fits ? std::optional(std::move(found)) : std::nullopt;
}

/// The best of some attempts with curves of ever finer proxies, each half as fine again as the last one; the first
/// where little looks wrong ends it.
template <typename Scalar>
Attempt<Scalar> fit_to_finer_curves(const Body<Scalar>& body, const curve::CurveResult<Scalar>& given,
                                    const SkeletonTemplate& wanted, const ExtractOptions& options, int attempts) {
    Stopwatch first;
    const auto less = less_centred(body, given.curve, wanted, options);
    const curve::CurveResult<Scalar>& curve = less ? *less : given;
    const double more_curves = first.lap();
    Attempt<Scalar> best = fit_to_curve(body, curve, wanted, options);
    best.timings.curve += more_curves;
    curve::CurveOptions finer = options.curve;
    for (int attempt = 1; attempt < attempts; ++attempt) {
        const bool good = best.outcome && best.outcome->misplaced < suspicious && best.outcome->curve.converged;
        if (good || (!best.outcome && best.outcome.failure().reason == FailureReason::no_body)) break;
        Stopwatch stage;
        finer.proxy.vertices = std::min(finer.proxy.vertices + finer.proxy.vertices / 2, curve::most_proxy_vertices);
        const curve::CurveResult<Scalar> finer_curve = find_curve(body, finer);
        StageTimings timings = best.timings;
        timings.curve += stage.lap();
        Attempt<Scalar> next = fit_to_curve(body, finer_curve, wanted, options);
        timings = timings + next.timings;
        const bool refused = !next.outcome && next.outcome.failure().reason == FailureReason::no_body;
        const bool better = next.outcome && (!best.outcome || faults(*next.outcome) < faults(*best.outcome));
        if (refused || better) best = std::move(next);
        best.timings = timings;
    }
    return best;
}

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

/// The result in the input's coordinates.
template <typename Scalar>
Outcome<Fit<Scalar>> to_fit(const Body<Scalar>& body, Attempt<Scalar> attempt) {
    if (!attempt.outcome) return attempt.outcome.failure();
    Candidate<Scalar>& found = *attempt.outcome;
    std::vector<std::string>& warnings = found.skeleton.quality.warnings;
    warnings.insert(warnings.end(), body.repairs.begin(), body.repairs.end());
    if (body.dropped_pieces > 0)
        warnings.push_back(std::to_string(body.dropped_pieces) + " pieces not connected to the body were left out");
    if (!found.curve.converged) warnings.push_back("the curve skeleton's contraction did not converge");
    found.skeleton = anatomy::no_surer_than_the_whole(std::move(found.skeleton));
    return Fit<Scalar>{surface::to_input(body, found.skeleton), surface::to_input(body, found.curve.curve),
                       body.similarity.scale * found.geodesic_diameter, attempt.timings};
}

/// Fits the template to a body that touches itself: to its surface cut there, in that of the ways to cut it where the
/// joints are most likely, or, where none serves, as it is.
template <typename Scalar>
Outcome<Fit<Scalar>> fit_touching_body(const Body<Scalar>& body, const curve::CurveResult<Scalar>& found,
                                       const SkeletonTemplate& wanted, const ExtractOptions& options, int attempts) {
    const CurveSkeleton<Scalar>& curve = found.curve;
    // Two bodies that touch are refused first: cutting them apart would hide that there are two.
    if (const auto embedding = embedding::embed(curve, wanted, options.matching))
        if (const auto failure = not_single(curve, *embedding)) return *failure;

    Stopwatch stage;
    const int contacts = embedding::contact_count(curve);
    const auto ways = embedding::part_contacts(body, curve, wanted, options.matching, options.curve);
    StageTimings cutting;
    cutting.curve = stage.lap();
    const auto finish = [&](const Body<Scalar>& fitted_body, Attempt<Scalar> attempt, bool cut) {
        if (attempt.outcome)
            attempt.outcome->skeleton = less_certain_for_contacts(std::move(attempt.outcome->skeleton), contacts, cut);
        attempt.timings = attempt.timings + cutting;
        return to_fit(fitted_body, std::move(attempt));
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
        return finish(best_way->body, *std::move(best), true);
    }
    return finish(body, fit_to_finer_curves(body, found, wanted, options, attempts), false);
}

template <typename Scalar>
Outcome<Fit<Scalar>> fit_to_body(const Body<Scalar>& body, const curve::CurveResult<Scalar>& curve,
                                 const SkeletonTemplate& wanted, const ExtractOptions& options, int attempts) {
    if (embedding::contact_count(curve.curve) > 0) return fit_touching_body(body, curve, wanted, options, attempts);
    return to_fit(body, fit_to_finer_curves(body, curve, wanted, options, attempts));
}

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

/// A body in which the whole template has not been found, as one that lacks a limb: by the first curve, of ever finer
/// proxies, that lets it in. What no such template nearly fits is not looked at more finely.
template <typename Scalar>
Outcome<Fit<Scalar>> fit_partial(const Body<Scalar>& body, const SkeletonTemplate& wanted,
                                 const ExtractOptions& options) {
    constexpr double nearly = 2; // times the distortion of what fits well
    curve::CurveOptions finer = options.curve;
    StageTimings timings;
    for (int i = 0; i < most_attempts; ++i) {
        Stopwatch stage;
        const curve::CurveResult<Scalar> curve = find_curve(body, finer);
        timings.curve += stage.lap();
        auto [attempt, least_distortion] = fit_part_to_curve(body, curve, wanted, options);
        timings = timings + attempt.timings;
        attempt.timings = timings;
        if (attempt.outcome) return to_fit(body, std::move(attempt));
        if (least_distortion > nearly * well_fitted) break;
        finer.proxy.vertices = std::min(finer.proxy.vertices + finer.proxy.vertices / 2, curve::most_proxy_vertices);
    }
    return Failure{FailureReason::no_match, "no human body, nor one that lacks a limb"};
}

/// The components that get a curve each.
template <typename Scalar>
std::vector<surface::ManifoldParts<Scalar>> closable_components(const TriangleMesh<Scalar>& mesh) {
    constexpr double least_area = 1e-3;
    constexpr Eigen::Index least_faces = 4; // fewer enclose nothing, whatever is closed
    std::vector<surface::ManifoldParts<Scalar>> parts = surface::manifold_parts(mesh, least_area);
    std::erase_if(parts,
                  [](const surface::ManifoldParts<Scalar>& part) { return part.mesh.faces.rows() < least_faces; });
    if (parts.empty())
        throw Error(ErrorCode::bad_input, "the mesh has no component that encloses anything; close its surface");
    return parts;
}

template <typename Scalar>
bool is_all_of(const surface::ManifoldParts<Scalar>& part, const TriangleMesh<Scalar>& mesh) {
    return part.mesh.faces.rows() == mesh.faces.rows() && part.mesh.vertices.rows() == mesh.vertices.rows();
}

/// The diagonal of a mesh's bounding box along the axes that a similarity turns to x, y and z; in the mesh's unit.
template <typename Scalar>
Scalar diagonal_along(const Similarity<Scalar>& similarity, const Points<Scalar>& vertices) {
    Points<Scalar> turned(vertices.rows(), 3);
    for (Eigen::Index v = 0; v < vertices.rows(); ++v)
        core::set_point<Scalar>(turned, v, similarity.to_canonical(core::point(vertices, v)));
    return similarity.scale * core::bounding_diagonal(turned);
}

} // namespace detail

SKELGEN_INLINE void validate(const ExtractOptions& options) {
    if (!options.skeleton_template.joints.empty()) validate_template(options.skeleton_template);
    surface::validate(options.prepare);
    curve::validate(options.curve);
    embedding::validate(options.matching);
    refinement::validate(options.refinement);
    symmetry::validate(options.sides);
}

template <typename Scalar>
Outcome<Fit<Scalar>> fit(const Body<Scalar>& body, const curve::CurveResult<Scalar>& curve,
                         const SkeletonTemplate& skeleton_template, const ExtractOptions& options) {
    validate(options);
    validate_template(skeleton_template);
    return detail::fit_to_body(body, curve, skeleton_template, options, detail::most_attempts);
}

namespace detail {

/// A surface that was made of pieces, or leaves some out, is not what was given: its limbs may have been fused or
/// shortened. So much less can the skeleton be trusted: a working value, that of bodies which were cut.
inline constexpr double trust_in_repaired = 0.75;

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
    constexpr double unlikely = 0.1; // as anatomy::estimate_confidence has it
    const auto misplaced =
        std::count_if(skeleton.joints.begin(), skeleton.joints.end(),
                      [](const Joint<Scalar>& joint) { return joint.is_present && joint.confidence < unlikely; });
    return skeleton.quality.sides_confidence / static_cast<double>(1 + misplaced);
}

/// The template in the curve of a body.
template <typename Scalar>
Outcome<Fit<Scalar>> fit_whole(const Body<Scalar>& body, const SkeletonTemplate& wanted, const ExtractOptions& options,
                               int attempts) {
    Stopwatch stage;
    const curve::CurveResult<Scalar> curve = find_curve(body, options.curve);
    const double curve_time = stage.lap();
    Outcome<Fit<Scalar>> found = fit_to_body(body, curve, wanted, options, attempts);
    if (found) found->timings.curve += curve_time;
    return found;
}

/// The same for a body opened where it has grown together with itself, or, where the template fits no such one, for the
/// body as it is, but for an envelope: that has grown together where its pieces lie close to each other.
template <typename Scalar>
Outcome<Fit<Scalar>> fit_opened(const Body<Scalar>& body, const SkeletonTemplate& wanted, const ExtractOptions& options,
                                int attempts, bool is_envelope) {
    Stopwatch stage;
    const std::optional<Body<Scalar>> opened = surface::open_handles(body);
    const double opening = stage.lap();
    Outcome<Fit<Scalar>> found = fit_whole(opened ? *opened : body, wanted, options, attempts);
    if (found && opened) found->skeleton = less_certain(std::move(found->skeleton), trust_in_grown_together);
    const bool is_settled = found || !opened || is_envelope || found.failure().reason == FailureReason::no_body;
    if (!is_settled) found = fit_whole(body, wanted, options, 1);
    if (found) found->timings.surface += opening;
    return found;
}

/// A skeleton found in a body that the remedy made of the mesh, with what that says of its certainty.
template <typename Scalar>
Outcome<Fit<Scalar>> judged_by_surface(Outcome<Fit<Scalar>> found, const Body<Scalar>& body, surface::Remedy remedy,
                                       const TriangleMesh<Scalar>& mesh) {
    constexpr double much_noise = 0.005; // a centimetre on a person
    if (!found) return found;
    const double noise = smoothed_away(body, mesh);
    const bool is_noisy = noise > much_noise;
    if (is_noisy) found->skeleton.quality.warnings.push_back(noise_smoothed(noise));
    const bool is_as_given = remedy == surface::Remedy::largest_piece && body.dropped_pieces == 0 && !is_noisy;
    if (!is_as_given) found->skeleton = less_certain(std::move(found->skeleton), trust_in_repaired);
    return found;
}

/// Makes one surface of a mesh by the gentlest remedy that serves, as what comes out shows: the first skeleton that is
/// sure, or the surest of all. Of several bodies none is taken unless the caller says which.
template <typename Scalar>
Outcome<FittedBody<Scalar>> fit_to_best_surface(const TriangleMesh<Scalar>& mesh, const SkeletonTemplate& wanted,
                                                const ExtractOptions& options) {
    constexpr double sure = 0.4;
    Stopwatch stage;
    const surface::BodyMaterial<Scalar> material = surface::gather(mesh, options.prepare);
    StageTimings timings{.surface = stage.lap()};
    if (material.bodies > 1 && options.prepare.component == 0)
        return Failure{FailureReason::no_body,
                       std::to_string(material.bodies) +
                           " bodies apart; give each a file of its own, or take one by its number (--component)"};
    std::optional<Outcome<Fit<Scalar>>> best;
    Body<Scalar> best_body;
    std::optional<std::pair<Body<Scalar>, surface::Remedy>> first;
    for (const surface::Remedy remedy : material.remedies) {
        const bool is_no_body = best && !*best && best->failure().reason == FailureReason::no_body;
        if (remedy == surface::Remedy::rounded && is_no_body) break; // however round
        stage.lap();
        Outcome<Body<Scalar>> body = surface::make_body_by(remedy, material, options.prepare);
        timings.surface += stage.lap();
        if (!body) {
            if (!best) best = body.failure();
            continue;
        }
        const bool is_envelope = remedy == surface::Remedy::envelope || remedy == surface::Remedy::wrap;
        if (is_envelope)
            if (const auto failure = too_compact(*body)) {
                if (!best) best = *failure;
                continue;
            }
        // What is wrong with one of several surfaces is not the curve's doing: the next surface may serve better.
        const int attempts = material.remedies.back() == material.remedies.front() ||
                                     material.remedies.back() == surface::Remedy::rounded
                                 ? most_attempts
                                 : 1;
        Outcome<Fit<Scalar>> found = fit_opened(*body, wanted, options, attempts, is_envelope);
        if (found) timings = timings + found->timings;
        found = judged_by_surface(std::move(found), *body, remedy, mesh);
        // What is thin where gaps are open is no body where they are closed: that takes long on boards and bars.
        const bool is_too_long = is_envelope && !found && found.failure().what == too_long_a_shape().what;
        if (!found && !first) first = std::pair(*body, remedy);
        const bool better = found && (!best || !*best || sureness(found->skeleton) > sureness((*best)->skeleton));
        if (better || !best) {
            best = std::move(found);
            best_body = *std::move(body);
        }
        if (is_too_long || (*best && sureness((*best)->skeleton) >= sure)) break;
    }
    if (!*best && best->failure().reason == FailureReason::no_match && first) {
        auto& [body, remedy] = *first;
        Outcome<Fit<Scalar>> partial = fit_partial(body, wanted, options);
        if (partial) {
            timings = timings + partial->timings;
            best = judged_by_surface(std::move(partial), body, remedy, mesh);
            best_body = std::move(body);
        }
    }
    if (!*best) return best->failure();
    (*best)->timings = timings;
    return FittedBody<Scalar>{**std::move(best), std::move(best_body)};
}

} // namespace detail

template <typename Scalar>
Extraction<Scalar> extract_skeleton(const TriangleMesh<Scalar>& mesh, const ExtractOptions& options) {
    return extract_body(mesh, options).extraction;
}

template <typename Scalar>
FittedBody<Scalar> extract_body(const TriangleMesh<Scalar>& mesh, const ExtractOptions& options) {
    detail::Stopwatch total;
    validate(options);
    const SkeletonTemplate& wanted =
        options.skeleton_template.joints.empty() ? builtin_template("human21") : options.skeleton_template;

    Outcome<FittedBody<Scalar>> found = detail::fit_to_best_surface(mesh, wanted, options);
    if (!found) throw Error(ErrorCode::no_skeleton, found.failure().what);
    found->extraction.timings.total = total.lap();
    return *std::move(found);
}

template <typename Scalar>
std::vector<curve::CurveResult<Scalar>> find_curves(const TriangleMesh<Scalar>& mesh, const ExtractOptions& options) {
    validate(options);
    surface::require_surface(mesh);
    const auto components = detail::closable_components(mesh);
    std::optional<Scalar> size;
    if (components.size() > 1 || !detail::is_all_of(components.front(), mesh))
        size = detail::diagonal_along(surface::canonical_form(mesh).similarity, mesh.vertices);
    std::vector<curve::CurveResult<Scalar>> out;
    for (const surface::ManifoldParts<Scalar>& component : components) {
        const Body<Scalar> body = prepare(component.mesh, options.prepare);
        // What has one component alone has that one's axes.
        const Scalar all = size ? *size : detail::diagonal_along(body.similarity, mesh.vertices);
        const Scalar own = body.similarity.scale * core::bounding_diagonal(body.mesh.vertices);
        curve::CurveOptions relative = options.curve;
        relative.centring.spacing = std::min(1.0, relative.centring.spacing * static_cast<double>(all / own));
        curve::CurveResult<Scalar> found = find_curve(body, relative);
        found.curve = surface::to_input(body, found.curve);
        for (std::vector<int>& region : found.curve.regions)
            for (int& vertex : region) vertex = component.source[static_cast<std::size_t>(vertex)];
        out.push_back(std::move(found));
    }
    return out;
}

template <typename Scalar>
CurveSkeleton<Scalar> find_curve_skeleton(const TriangleMesh<Scalar>& mesh, const ExtractOptions& options) {
    const Body<Scalar> body = prepare(mesh, options.prepare);
    return surface::to_input(body, find_curve(body, options.curve).curve);
}

} // namespace skelgen
