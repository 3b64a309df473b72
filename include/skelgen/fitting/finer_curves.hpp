#pragma once

#include <skelgen/fitting/attempt.hpp>

namespace skelgen::fitting {

/// Curves of ever finer proxies that are tried, the first one among them.
inline constexpr int most_attempts = 3;

/// The best of some attempts with curves of ever finer proxies, each half as fine again as the last one; the first
/// where little looks wrong ends it.
template <typename Scalar>
[[nodiscard]] Attempt<Scalar> fit_to_finer_curves(const Body<Scalar>& body, const curve::CurveResult<Scalar>& given,
                                                  const SkeletonTemplate& wanted, const ExtractOptions& options,
                                                  int attempts);

} // namespace skelgen::fitting

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/fitting/impl/finer_curves.hpp>
#endif
