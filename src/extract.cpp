#include <skelgen/extract.hpp>

#include <optional>
#include <string>
#include <utility>

#include <skelgen/core/error.hpp>
#include <skelgen/core/template_rules.hpp>
#include <skelgen/curve/limb_ends.hpp>
#include <skelgen/io/template_json.hpp>

#include "extract/back_to_input.hpp"
#include "extract/body_curve.hpp"
#include "extract/fit_skeleton.hpp"
#include "extract/stopwatch.hpp"

namespace skelgen {
namespace {

using detail::BackToInput, detail::BodyCurve, detail::find_body_curve, detail::SkeletonFit, detail::fit_skeleton,
    detail::Stopwatch;

/// Where limbs touch, it may have been cut in the wrong place, and uncut, the curve runs on from one to the other.
void doubt_contacts(KinematicSkeleton<double>& skeleton, int contacts, bool cut) {
    const double often_right = cut ? 0.75 : 0.7;
    skeleton.quality.sides_confidence *= often_right;
    for (Joint<double>& joint : skeleton.joints) joint.confidence *= often_right;
    skeleton.quality.warnings.push_back("the body touches itself in " + std::to_string(contacts) +
                                        (contacts == 1 ? " place" : " places") +
                                        (cut ? ": it was cut there" : ": limbs may be mistaken"));
}

/// Fits the skeleton to a body that touches itself: to its surface cut there, or, where that fails, as it is. `found`
/// becomes what served.
SkeletonFit fit_touching_body(BodyCurve& found, const SkeletonTemplate& wanted, const ExtractOptions& options,
                              StageTimings& timings) {
    Stopwatch stage;
    detail::refuse_company(found.curve, wanted, options.matching);
    const int contacts = cycle_count(found.curve);
    std::optional<BodyCurve> parted = detail::part_contacts(found, wanted, options);
    timings.curve += stage.lap();
    std::optional<SkeletonFit> fit;
    try {
        if (parted) fit = fit_skeleton(*parted, wanted, options, timings);
    } catch (const Error& error) {
        if (error.code() != ErrorCode::no_skeleton) throw;
    }
    const bool cut = fit.has_value();
    if (cut)
        found = *std::move(parted);
    else
        fit = fit_skeleton(found, wanted, options, timings);
    doubt_contacts(fit->skeleton, contacts, cut);
    return *std::move(fit);
}

SkeletonFit fit_body(BodyCurve& found, const SkeletonTemplate& wanted, const ExtractOptions& options,
                     StageTimings& timings) {
    return cycle_count(found.curve) > 0 ? fit_touching_body(found, wanted, options, timings)
                                        : fit_skeleton(found, wanted, options, timings);
}

} // namespace

template <typename Scalar>
CurveSkeleton<Scalar> find_curve_skeleton(const TriangleMesh<Scalar>& mesh, const ExtractOptions& options) {
    const BodyCurve found = find_body_curve(mesh, options);
    return BackToInput<Scalar>(found.similarity)
        .curve(settle_limb_ends(found.curve, found.body.mesh), found.body.source);
}

template <typename Scalar>
Extraction<Scalar> extract_skeleton(const TriangleMesh<Scalar>& mesh, const ExtractOptions& options) {
    Stopwatch total, stage;
    const SkeletonTemplate& wanted =
        options.skeleton_template.joints.empty() ? builtin_template("human21") : options.skeleton_template;
    validate_template(wanted);

    BodyCurve found = find_body_curve(mesh, options);
    Extraction<Scalar> out;
    out.timings.curve = stage.lap();

    SkeletonFit fit = fit_body(found, wanted, options, out.timings);
    if (found.body.dropped_pieces > 0)
        fit.skeleton.quality.warnings.push_back(std::to_string(found.body.dropped_pieces) +
                                                " pieces not connected to the body were left out");

    const BackToInput<Scalar> back(found.similarity);
    out.skeleton = back.skeleton(fit.skeleton);
    out.curve = back.curve(settle_limb_ends(found.curve, found.body.mesh), found.body.source);
    out.geodesic_diameter = found.similarity.scale * fit.geodesic_diameter;
    out.timings.total = total.lap();
    return out;
}

template CurveSkeleton<float> find_curve_skeleton(const TriangleMesh<float>&, const ExtractOptions&);
template CurveSkeleton<double> find_curve_skeleton(const TriangleMesh<double>&, const ExtractOptions&);
template Extraction<float> extract_skeleton(const TriangleMesh<float>&, const ExtractOptions&);
template Extraction<double> extract_skeleton(const TriangleMesh<double>&, const ExtractOptions&);

} // namespace skelgen
