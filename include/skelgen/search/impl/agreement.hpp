#pragma once

#include <skelgen/search/agreement.hpp>

#include <algorithm>
#include <cmath>

namespace skelgen::search {

SKELGEN_INLINE double agreement(const Points<double>& a, const Points<double>& b, double extent) {
    constexpr double near = 0.05, farthest = 0.3; // of the extent
    double sum = 0;
    Eigen::Index both = 0;
    for (Eigen::Index j = 0; j < a.rows(); ++j) {
        const double distance = (a.row(j) - b.row(j)).norm() / extent;
        if (!std::isfinite(distance)) continue;
        sum += std::min(distance, farthest);
        ++both;
    }
    if (2 * both < a.rows()) return 0;
    const double mean = sum / static_cast<double>(both);
    return std::exp(-mean * mean / (near * near));
}

} // namespace skelgen::search
