#pragma once

#include <skelgen/fitting/attempt.hpp>

namespace skelgen::fitting {

/// A body in which the whole template has not been found, as one that lacks a limb: by the first curve, of ever finer
/// proxies, that lets it in. What no such template nearly fits is not looked at more finely.
template <typename Scalar>
[[nodiscard]] Outcome<Fit<Scalar>> fit_partial(const Body<Scalar>& body, const SkeletonTemplate& wanted,
                                               const ExtractOptions& options);

} // namespace skelgen::fitting

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/fitting/impl/partial_body.hpp>
#endif
