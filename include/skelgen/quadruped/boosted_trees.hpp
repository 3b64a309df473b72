#pragma once

#include <array>
#include <cstddef>

namespace skelgen::quadruped {

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

} // namespace skelgen::quadruped
