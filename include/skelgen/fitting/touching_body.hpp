#pragma once

#include <skelgen/fitting/attempt.hpp>

namespace skelgen::fitting {

/// Fits the template to a body that touches itself: to its surface cut there, in that of the ways to cut it where the
/// joints are most likely, or, where none serves, as it is.
template <typename Scalar>
[[nodiscard]] Outcome<Fit<Scalar>> fit_touching_body(const Body<Scalar>& body, const curve::CurveResult<Scalar>& found,
                                                     const SkeletonTemplate& wanted, const ExtractOptions& options,
                                                     int attempts);

} // namespace skelgen::fitting

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/fitting/impl/touching_body.hpp>
#endif
