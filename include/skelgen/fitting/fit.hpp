#pragma once

#include <skelgen/fitting/finer_curves.hpp>

namespace skelgen::fitting {

/// Fits a template to a body and its curve skeleton (LF20): lays it into the curve, places the joints by
/// cross-sections and anatomy, tells the sides, completes the skeleton. Where that fails or looks wrong, a limb has
/// been lost or a junction shifted on the way to the curve: curves of finer proxies are tried. Where the curve has
/// loops the body touches itself: its surface is cut there and the curve found again. Another template on the same body
/// and curve takes another call. `options.prepare` and `options.skeleton_template` do not count.
/// \param attempts curves that are tried at most, the given one among them; 1 or more.
/// \returns the failure
/// where no such skeleton is in the body. \throws Error usage when an option is out of its range, bad_input when the
/// template breaks a rule.
template <typename Scalar>
[[nodiscard]] Outcome<Fit<Scalar>> fit(const Body<Scalar>& body, const curve::CurveResult<Scalar>& curve,
                                       const SkeletonTemplate& skeleton_template, const ExtractOptions& options = {},
                                       int attempts = most_attempts);

} // namespace skelgen::fitting

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/fitting/impl/fit.hpp>
#endif
