#pragma once

#include <skelgen/fitting/fit.hpp>

#include <utility>

#include <skelgen/core/parallel.hpp>
#include <skelgen/core/stopwatch.hpp>
#include <skelgen/core/template_rules.hpp>
#include <skelgen/embedding/loop_cuts.hpp>
#include <skelgen/fitting/touching_body.hpp>

namespace skelgen::fitting {

namespace detail {

/// Where a body touches itself, the curve's regions say: a draft has none.
template <typename Scalar>
Outcome<Fit<Scalar>> fit_finished(const Body<Scalar>& body, const curve::CurveResult<Scalar>& draft,
                                  const SkeletonTemplate& skeleton_template, ExtractOptions options, int attempts) {
    core::Stopwatch stage;
    options.curve.is_draft = false;
    const curve::CurveResult<Scalar> curve = finished(draft, body);
    const double curve_time = stage.lap();
    Outcome<Fit<Scalar>> found = fit(body, curve, skeleton_template, options, attempts);
    if (found) found->timings.curve += curve_time;
    return found;
}

} // namespace detail

template <typename Scalar>
Outcome<Fit<Scalar>> fit(const Body<Scalar>& body, const curve::CurveResult<Scalar>& curve,
                         const SkeletonTemplate& skeleton_template, const ExtractOptions& options, int attempts) {
    validate(options);
    validate_template(skeleton_template);
    const core::ThreadScope threads(options.threads);
    if (embedding::contact_count(curve.curve) > 0)
        return curve.is_draft ? detail::fit_finished(body, curve, skeleton_template, options, attempts)
                              : fit_touching_body(body, curve, skeleton_template, options, attempts);
    return to_fit(body, fit_to_finer_curves(body, curve, skeleton_template, options, attempts), options);
}

} // namespace skelgen::fitting
