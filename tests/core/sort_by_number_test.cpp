#include <skelgen/core/sort_by_number.hpp>

#include <random>

#include "catch.hpp"

using skelgen::core::sorted_by_number;

TEMPLATE_TEST_CASE("numbers are sorted as std::sort has them", "[core]", float, double) {
    using Entries = std::vector<std::pair<TestType, int>>;
    std::mt19937_64 random(3);
    const auto check = [](Entries entries) {
        Entries expected = entries;
        std::sort(expected.begin(), expected.end());
        CHECK(sorted_by_number(std::move(entries)) == expected);
    };
    for (const int count : {0, 1, 10, 5000}) {
        Entries spread, level, far, heaped;
        for (int i = 0; i < count; ++i) {
            const auto number = static_cast<TestType>(static_cast<double>(random() % 100000) - 50000);
            spread.emplace_back(number, count - i);
            level.emplace_back(TestType(7), static_cast<int>(random() % 1000));
            far.emplace_back(i == 3 ? TestType(1e30) : number, i);
            heaped.emplace_back(number * number * number, i);
        }
        check(spread);
        check(level);
        check(far);
        check(heaped);
    }
}
