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

/// A tree of questions: is a number (its place among all) above a bound? From question i on to 2 i + 1 where it is not,
/// to 2 i + 2 where it is. The last answers add their voice to a logarithm of odds.
struct QuestionTree {
    std::array<unsigned char, 7> number;
    std::array<double, 7> bound;
    std::array<double, 8> voice;
};

/// What all trees together say of some numbers. O(trees).
template <std::size_t Trees, std::size_t Numbers>
[[nodiscard]] double voices_of(const std::array<QuestionTree, Trees>& trees,
                               const std::array<double, Numbers>& numbers) {
    double out = 0;
    for (const QuestionTree& tree : trees) {
        std::size_t place = 0;
        while (place < tree.number.size()) {
            const auto value = static_cast<float>(numbers[tree.number[place]]); // as the trees were fitted
            place = 2 * place + (value > tree.bound[place] ? 2 : 1);
        }
        out += tree.voice[place - tree.number.size()];
    }
    return out;
}

/// The logarithm of the odds of a probability, within what 1e-9 has.
[[nodiscard]] inline double log_odds(double probability) {
    return std::log(std::max(probability, 1e-9) / std::max(1 - probability, 1e-9));
}

/// The probability of a logarithm of odds.
[[nodiscard]] inline double logistic(double log_odds) { return 1 / (1 + std::exp(-log_odds)); }

} // namespace skelgen::core
