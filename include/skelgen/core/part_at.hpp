#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <utility>

namespace skelgen::core {

/// As `std::nth_element`, which leaves the order before and behind `middle` to each standard library: what is added up
/// in that order would be rounded otherwise by each. This order is GNU's. `less` has to tell any two entries apart.
template <typename Iterator, typename Less>
void part_at(Iterator first, Iterator middle, Iterator last, Less less) {
    if (first == last || middle == last) return;
    int rounds = 2 * (static_cast<int>(std::bit_width(static_cast<std::size_t>(last - first))) - 1);
    while (last - first > 3 && rounds-- > 0) {
        // The median of three becomes the first, which parts the others.
        Iterator a = first + 1, b = first + (last - first) / 2, c = last - 1;
        if (!less(*a, *b)) std::swap(a, b);
        std::iter_swap(first, less(*b, *c) ? b : less(*a, *c) ? c : a);
        Iterator low = first + 1, high = last;
        for (;; ++low) {
            while (less(*low, *first)) ++low;
            do --high;
            while (less(*first, *high));
            if (!(low < high)) break;
            std::iter_swap(low, high);
        }
        (low <= middle ? first : last) = low;
    }
    if (last - first <= 3) return std::sort(first, last, less);
    // Where medians part badly: a heap of the lowest, its highest on top.
    const auto size = middle + 1 - first;
    const auto sink = [&](auto hole) {
        for (auto child = 2 * hole + 1; child < size; child = 2 * hole + 1) {
            if (child + 1 < size && less(first[child], first[child + 1])) ++child;
            if (!less(first[hole], first[child])) return;
            std::iter_swap(first + hole, first + child);
            hole = child;
        }
    };
    for (auto hole = size / 2; hole-- > 0;) sink(hole);
    for (Iterator other = middle + 1; other != last; ++other) {
        if (!less(*other, *first)) continue;
        std::iter_swap(other, first);
        sink(decltype(size - size){0});
    }
    std::iter_swap(first, middle);
}

} // namespace skelgen::core
