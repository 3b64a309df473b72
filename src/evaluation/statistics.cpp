#include <skelgen/evaluation/statistics.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <skelgen/core/error.hpp>

namespace skelgen::evaluation {
namespace {

constexpr std::size_t lanes = 8;        // running sums kept apart, as NumPy does for the processor's sake
constexpr std::size_t block_size = 128; // longer spans are halved

double sum_in_order(double start, std::span<const double> values) {
    for (const double value : values) start += value;
    return start;
}

double sum_block(std::span<const double> values) {
    std::array<double, lanes> sums{};
    std::copy_n(values.begin(), lanes, sums.begin());
    const std::size_t whole = values.size() - values.size() % lanes;
    for (std::size_t i = lanes; i < whole; ++i) sums[i % lanes] += values[i];
    const double total = ((sums[0] + sums[1]) + (sums[2] + sums[3])) + ((sums[4] + sums[5]) + (sums[6] + sums[7]));
    return sum_in_order(total, values.subspan(whole));
}

void require_values(std::span<const double> values) {
    if (values.empty()) throw Error(ErrorCode::usage, "no values to take statistics of; give one at least");
}

} // namespace

double pairwise_sum(std::span<const double> values) {
    if (values.size() < lanes) return sum_in_order(0, values);
    if (values.size() <= block_size) return sum_block(values);
    std::size_t half = values.size() / 2;
    half -= half % lanes;
    return pairwise_sum(values.first(half)) + pairwise_sum(values.subspan(half));
}

double mean(std::span<const double> values) {
    require_values(values);
    return pairwise_sum(values) / static_cast<double>(values.size());
}

double percentile(std::span<const double> values, double percent) {
    require_values(values);
    if (!(percent >= 0 && percent <= 100))
        throw Error(ErrorCode::usage, "a percentile lies between 0 and 100, not at " + std::to_string(percent));
    std::vector<double> sorted(values.begin(), values.end());
    std::sort(sorted.begin(), sorted.end());

    const double position = static_cast<double>(sorted.size() - 1) * (percent / 100);
    const auto below = static_cast<std::size_t>(std::floor(position));
    const double low = sorted[below];
    const double high = sorted[std::min(below + 1, sorted.size() - 1)];
    const double part = position - std::floor(position);
    // From the nearer end: exact at both ends, and never outside of them by a rounding error.
    return part < 0.5 ? low + (high - low) * part : high - (high - low) * (1 - part);
}

} // namespace skelgen::evaluation
