#pragma once

#include <span>

namespace skelgen::evaluation {

/// The sum by halves: its rounding error grows with log(n) instead of n. Same additions in the same order as NumPy's
/// `sum`, so that figures can be compared with a script's to the last digit. O(n).
[[nodiscard]] double pairwise_sum(std::span<const double> values);

/// The mean. \throws Error usage when there are no values.
[[nodiscard]] double mean(std::span<const double> values);

/// The value below which `percent` (0 to 100) of the values lie, linear between neighbours in order: NumPy's default.
/// O(n log n). \throws Error usage when there are no values or `percent` is out of range.
[[nodiscard]] double percentile(std::span<const double> values, double percent);

} // namespace skelgen::evaluation
