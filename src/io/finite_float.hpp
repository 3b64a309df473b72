#pragma once

#include <cmath>
#include <limits>

namespace skelgen::io::detail {

/// A number in single precision; 0 where it is none there. Programs write no numbers where they have nothing to say of
/// a vertex, and refuse to read them: nothing is lost by 0.
[[nodiscard]] inline float finite_float(double value) {
    constexpr double most = std::numeric_limits<float>::max();
    return std::abs(value) <= most ? static_cast<float>(value) : 0.0F;
}

} // namespace skelgen::io::detail
