#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace skelgen::core {

/// Sorts pairs of a finite number and an index, as std::sort does. O(n) where the numbers are spread out, as points are
/// along a line; O(n log n) at worst.
template <typename Number>
[[nodiscard]] std::vector<std::pair<Number, int>> sorted_by_number(std::vector<std::pair<Number, int>> entries) {
    constexpr std::size_t few = 1024, in_each = 4; // entries, worth it and on average in a slot
    if (entries.size() < few) {
        std::sort(entries.begin(), entries.end());
        return entries;
    }
    const auto [least, most] = std::minmax_element(entries.begin(), entries.end());
    const Number low = least->first, range = most->first - low;
    const std::size_t slots = entries.size() / in_each;
    const auto slot_of = [&](const std::pair<Number, int>& entry) {
        const Number part = range > 0 ? (entry.first - low) / range : Number(0);
        return std::min(slots - 1, static_cast<std::size_t>(part * static_cast<Number>(slots)));
    };
    std::vector<std::size_t> begin(slots + 1, 0);
    for (const auto& entry : entries) ++begin[slot_of(entry) + 1];
    for (std::size_t s = 0; s < slots; ++s) begin[s + 1] += begin[s];
    std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
    std::vector<std::pair<Number, int>> out(entries.size());
    for (const auto& entry : entries) out[next[slot_of(entry)]++] = entry;
    for (std::size_t s = 0; s < slots; ++s)
        std::sort(out.begin() + static_cast<std::ptrdiff_t>(begin[s]),
                  out.begin() + static_cast<std::ptrdiff_t>(begin[s + 1]));
    return out;
}

} // namespace skelgen::core
