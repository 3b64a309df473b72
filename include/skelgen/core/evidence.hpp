#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace skelgen::core {

/// Numbers, each known by its witness: an enumeration that ends in `count`.
template <typename Witness>
struct EvidenceOf {
    std::array<double, static_cast<std::size_t>(Witness::count)> values{};

    [[nodiscard]] double& operator[](Witness witness) { return values[static_cast<std::size_t>(witness)]; }
    [[nodiscard]] double operator[](Witness witness) const { return values[static_cast<std::size_t>(witness)]; }
};

/// The logarithm of the odds of a probability, within what 1e-9 has.
[[nodiscard]] inline double log_odds(double probability) {
    return std::log(std::max(probability, 1e-9) / std::max(1 - probability, 1e-9));
}

/// The probability of a logarithm of odds.
[[nodiscard]] inline double logistic(double log_odds) { return 1 / (1 + std::exp(-log_odds)); }

} // namespace skelgen::core
