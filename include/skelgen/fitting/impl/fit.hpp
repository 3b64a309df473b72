#pragma once

#include <skelgen/fitting/fit.hpp>

#include <utility>

#include <skelgen/core/parallel.hpp>
#include <skelgen/core/template_rules.hpp>
#include <skelgen/embedding/loop_cuts.hpp>
#include <skelgen/fitting/touching_body.hpp>

namespace skelgen::fitting {

template <typename Scalar>
Outcome<Fit<Scalar>> fit(const Body<Scalar>& body, const curve::CurveResult<Scalar>& curve,
                         const SkeletonTemplate& skeleton_template, const ExtractOptions& options, int attempts) {
    validate(options);
    validate_template(skeleton_template);
    const core::ThreadScope threads(options.threads);
    if (embedding::contact_count(curve.curve) > 0)
        return fit_touching_body(body, curve, skeleton_template, options, attempts);
    return to_fit(body, fit_to_finer_curves(body, curve, skeleton_template, options, attempts));
}

} // namespace skelgen::fitting
