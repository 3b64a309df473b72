#pragma once

#include <algorithm>
#include <cmath>

#include <Eigen/Core>

namespace skelgen::render {

/// A rectangle of samples: columns [0, width), rows [top, bottom). Sample (x, y) sits at (x + 0.5, y + 0.5).
struct SampleRect {
    int width = 0;
    int top = 0;
    int bottom = 0;
};

/// Calls `visit(x, y, weights)` for each sample of `rect` inside the triangle, with barycentric weights; both windings
/// count as inside. Neighbouring triangles leave no gap; samples on a shared edge are visited for both.
template <typename Visit>
void rasterize_triangle(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c,
                        const SampleRect& rect, Visit&& visit) {
    const double area = (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
    if (std::abs(area) < 1e-12) return;
    // weights = at_origin + x * per_x + y * per_y
    const Eigen::Array3d per_x = Eigen::Array3d(b.y() - c.y(), c.y() - a.y(), a.y() - b.y()) / area;
    const Eigen::Array3d per_y = Eigen::Array3d(c.x() - b.x(), a.x() - c.x(), b.x() - a.x()) / area;
    const Eigen::Array3d at_a = Eigen::Array3d(1, 0, 0);

    const auto [low_y, high_y] = std::minmax({a.y(), b.y(), c.y()});
    const auto [low_x, high_x] = std::minmax({a.x(), b.x(), c.x()});
    const int first_y = std::max(rect.top, static_cast<int>(std::floor(std::max(low_y, double(rect.top)))));
    const int end_y = static_cast<int>(std::ceil(std::min(high_y, double(rect.bottom))));
    for (int y = first_y; y < end_y; ++y) {
        const Eigen::Array3d row = at_a - (a.x() - 0.5) * per_x + (y + 0.5 - a.y()) * per_y; // weights at x = 0
        double from = std::max(0.0, std::floor(low_x));
        double to = std::min(double(rect.width), std::ceil(high_x));
        constexpr double slack = 1e-7; // rounding must not open gaps between neighbours
        for (int i = 0; i < 3; ++i) {
            if (per_x[i] > 0) from = std::max(from, std::ceil(-row[i] / per_x[i] - slack));
            if (per_x[i] < 0) to = std::min(to, std::floor(-row[i] / per_x[i] + slack) + 1);
            if (per_x[i] == 0 && row[i] < 0) to = from;
        }
        if (!(from < to)) continue; // also keeps infinities of almost flat edges out of the conversion
        for (int x = static_cast<int>(from); x < to; ++x) visit(x, y, Eigen::Array3d(row + x * per_x));
    }
}

} // namespace skelgen::render
