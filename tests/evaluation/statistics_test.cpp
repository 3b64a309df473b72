#include <skelgen/evaluation/statistics.hpp>

#include <cstdint>
#include <numeric>
#include <vector>

#include <skelgen/core/error.hpp>

#include "catch.hpp"

namespace {

using namespace skelgen;
using namespace skelgen::evaluation;

TEST_CASE("percentiles lie between the neighbours in order") {
    const std::vector<double> values{4, 1, 3, 2};
    CHECK(percentile(values, 0) == 1);
    CHECK(percentile(values, 50) == 2.5);
    CHECK(percentile(values, 100) == 4);
    CHECK(percentile(values, 25) == 1.75);
    CHECK(percentile(values, 95) == Approx(3.85).epsilon(1e-15));
    CHECK(percentile(std::vector<double>{7}, 95) == 7);
}

TEST_CASE("a percentile of equal values is that value, without a rounding error") {
    CHECK(percentile(std::vector<double>(10, 0.1), 95) == 0.1);
}

TEST_CASE("statistics of nothing are refused") {
    CHECK_THROWS_AS(mean({}), Error);
    CHECK_THROWS_AS(percentile({}, 50), Error);
    CHECK_THROWS_AS(percentile(std::vector<double>{1}, 101), Error);
    CHECK_THROWS_AS(percentile(std::vector<double>{1}, -1), Error);
}

TEST_CASE("sums are exact where they can be, whatever the number of values") {
    for (const std::size_t n : {0U, 1U, 7U, 8U, 9U, 127U, 128U, 129U, 136U, 1000U, 4097U}) {
        std::vector<double> values(n);
        std::iota(values.begin(), values.end(), 1.0);
        CHECK(pairwise_sum(values) == static_cast<double>(n) * static_cast<double>(n + 1) / 2);
    }
}

TEST_CASE("sums are NumPy's to the last bit") {
    // numpy.sum([0.1] * n) and the mean of 1/1, ..., 1/1000, printed by NumPy 1.24 with repr().
    CHECK(pairwise_sum(std::vector<double>(7, 0.1)) == 0.7);
    CHECK(pairwise_sum(std::vector<double>(10, 0.1)) == 1.0);
    CHECK(pairwise_sum(std::vector<double>(300, 0.1)) == 29.999999999999996);
    std::vector<double> harmonic;
    for (int i = 1; i <= 1000; ++i) harmonic.push_back(1.0 / i);
    CHECK(mean(harmonic) == 0.007485470860550345);
    CHECK(percentile(harmonic, 95) == 0.01962745098039214);
}

} // namespace
