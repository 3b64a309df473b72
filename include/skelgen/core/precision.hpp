#pragma once

#include <cmath>
#include <limits>

namespace skelgen::core {

/// What adds up over a whole surface, and what is factorised, is double whatever the mesh's scalar: in float, the sum
/// of a million areas or the Cholesky factor of a stiff Laplacian would keep three digits of seven.
using Accumulator = double;

/// The part of a quantity that rounding may have left in it after a long computation: 1e-9 in double, 2e-5 in float.
/// Differences below it decide nothing, so that a turned, moved or rescaled body gives the same answer.
template <typename Scalar>
[[nodiscard]] inline Scalar rounding() {
    return std::sqrt(std::numeric_limits<Scalar>::epsilon()) / 16;
}

} // namespace skelgen::core
