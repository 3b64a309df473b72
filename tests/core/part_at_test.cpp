#include <skelgen/core/part_at.hpp>

#include <algorithm>
#include <functional>
#include <numeric>
#include <random>
#include <vector>

#include "catch.hpp"

TEST_CASE("entries are parted in GNU's order, whichever library there is", "[core]") {
    std::mt19937_64 random(5);
    for (int round = 0; round < 3000; ++round) {
        const auto count = 1 + random() % 400;
        std::vector<int> entries(count);
        std::iota(entries.begin(), entries.end(), 0);
        for (std::size_t i = count; i > 1; --i) std::swap(entries[i - 1], entries[random() % i]);
        const auto middle = static_cast<int>(random() % count);
        std::vector<int> parted = entries;
        skelgen::core::part_at(parted.begin(), parted.begin() + middle, parted.end(), std::less<>());
        INFO(count << " entries, parted at " << middle);
        for (int i = 0; i < static_cast<int>(count); ++i)
            REQUIRE((parted[static_cast<std::size_t>(i)] < middle) == (i < middle));
        REQUIRE(parted[static_cast<std::size_t>(middle)] == middle);
#ifdef __GLIBCXX__
        std::nth_element(entries.begin(), entries.begin() + middle, entries.end());
        REQUIRE(parted == entries); // among them are some that medians part badly
#endif
    }
}
