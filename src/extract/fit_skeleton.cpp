#include "fit_skeleton.hpp"

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <skelgen/core/error.hpp>
#include <skelgen/curve/extract_curve.hpp>
#include <skelgen/embedding/embed.hpp>
#include <skelgen/refinement/settle.hpp>

#include "stopwatch.hpp"

namespace skelgen::detail {
namespace {

/// The shape is no body's: another curve would not change that.
struct Refusal : Error {
    explicit Refusal(const std::string& what) : Error(ErrorCode::no_skeleton, what) {}
};

/// A body reaches far for its surface: toe to fingertip takes 1.34 (very heavy, or in a coat) to 1.85 times (thin) the
/// square root of its area; a ball 0.9, a dog 1.2, two people hand in hand 2.2. `diameter` is geodesic, for unit area.
void check_slender(double diameter) {
    constexpr double least = 1.26, most = 2.1;
    if (diameter < least) throw Refusal("no human body: too compact a shape for one with arms and legs");
    if (diameter > most) throw Refusal("no single human body: too thin and long a shape for one");
}

/// What goes on as far as an arm and belongs to no limb is another body's.
void check_alone(double unmatched_reach) {
    constexpr double arm = 0.17;
    if (unmatched_reach > arm)
        throw Refusal("no single human body: a limb is left over; separate bodies that are joined to others");
}

/// One in five is more than what is left of a body where limbs have been mistaken for each other.
void check_proportions(int misplaced, const SkeletonTemplate& wanted) {
    if (5 * static_cast<std::size_t>(misplaced) > wanted.joints.size())
        throw Error(ErrorCode::no_skeleton, "no human body: " + std::to_string(misplaced) +
                                                " joints of its skeleton would have bones of unlikely lengths");
}

/// Fits the skeleton to `curve`, and adds to `timings`. `surface` as from surface_graph(mesh). \throws Error
/// no_skeleton.
SkeletonFit fit_once(const TriangleMesh<double>& mesh, const CurveGraph<double>& surface,
                     const CurveSkeleton<double>& curve, const SkeletonTemplate& wanted, const ExtractOptions& options,
                     StageTimings& timings) {
    Stopwatch stage;
    const Embedding embedding = embed(curve, wanted, options.matching);
    check_alone(unmatched_reach(curve, embedding));
    timings.embed += stage.lap();

    SkeletonFit out;
    const std::vector<EndPoint> ends = find_end_points(mesh, surface, curve, embedding, wanted);
    out.geodesic_diameter = geodesic_diameter(ends);
    check_slender(out.geodesic_diameter);
    const RefinedJoints joints = refine(mesh, ends, curve, embedding, wanted, options.refinement);
    timings.refine += stage.lap();

    const SidesDecision sides = decide_sides(joints, wanted, options.sides);
    out.skeleton = assemble(joints, wanted, sides);
    out.misplaced = judge_joints(out.skeleton, wanted);
    check_proportions(out.misplaced, wanted);
    move_to_bones(out.skeleton, wanted);
    balance_bones(out.skeleton, wanted);
    keep_inside(out.skeleton, mesh, curve);
    measure_radii(out.skeleton, mesh);
    out.skeleton.quality.matched_nodes = embedding.matched_nodes;
    timings.sides += stage.lap();
    return out;
}

} // namespace

SkeletonFit fit_skeleton(BodyCurve& found, const SkeletonTemplate& wanted, const ExtractOptions& options,
                         StageTimings& timings) {
    constexpr int attempts = 3;   // each half as fine again as the last one
    constexpr int suspicious = 3; // joints misplaced
    std::optional<SkeletonFit> best;
    std::optional<Error> failure;
    ProxyOptions finer = options.proxy;
    CurveSkeleton<double> curve = found.curve;
    for (int attempt = 1;; ++attempt) {
        try {
            SkeletonFit fit = fit_once(found.body.mesh, found.surface, curve, wanted, options, timings);
            if (!best || fit.misplaced < best->misplaced) {
                best = std::move(fit);
                found.curve = curve;
            }
        } catch (const Refusal&) {
            throw;
        } catch (const Error& error) {
            if (error.code() != ErrorCode::no_skeleton) throw;
            if (!failure) failure = error;
        }
        if (attempt == attempts || (best && best->misplaced < suspicious)) break;
        finer.vertices += finer.vertices / 2;
        Stopwatch stage;
        curve = extract_curve(found.body.mesh, found.surface, build_proxy(found.body.mesh, finer), options.curve);
        timings.curve += stage.lap();
    }
    if (!best) throw *failure;
    return *std::move(best);
}

void refuse_company(const CurveSkeleton<double>& curve, const SkeletonTemplate& wanted,
                    const MatchingOptions& options) {
    std::optional<Embedding> embedding;
    try {
        embedding = embed(curve, wanted, options);
    } catch (const Error& error) {
        if (error.code() != ErrorCode::no_skeleton) throw;
    }
    if (embedding) check_alone(unmatched_reach(curve, *embedding));
}

} // namespace skelgen::detail
