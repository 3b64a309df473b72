#include "lines.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace skelgen::synth {
namespace {

constexpr double spacing = 0.25;   ///< of the points of a line, in radii
constexpr double soft_blend = 0.5; ///< in radii of the thinner tube: how far a joint of two tubes is rounded off
constexpr int finest_steps = 400;  ///< in which lengths along a line are measured

/// Points on the line, each a `spacing` of the radius after the one before, with one at each of the `stops`.
std::vector<double> parameters(const Line& line, const Width& radius, std::vector<double> stops) {
    stops.push_back(1);
    std::vector<double> found{0};
    double from = 0;
    for (const double to : stops) {
        const auto at = [=](int i) { return from + (to - from) * i / finest_steps; };
        std::vector<double> steps{0}; // up to there
        for (int i = 1; i <= finest_steps; ++i)
            steps.push_back(steps.back() + (line(at(i)) - line(at(i - 1))).norm() / (spacing * radius(at(i))));
        const int count = std::max(1, static_cast<int>(std::ceil(steps.back())));
        for (int k = 1, i = 1; k < count; ++k) {
            const double wanted = steps.back() * k / count;
            while (steps[static_cast<std::size_t>(i)] < wanted) ++i;
            const double before = steps[static_cast<std::size_t>(i - 1)], after = steps[static_cast<std::size_t>(i)];
            found.push_back(at(i - 1) + (at(i) - at(i - 1)) * (wanted - before) / (after - before));
        }
        found.push_back(to);
        from = to;
    }
    return found;
}

} // namespace

Width even(double radius) {
    return [=](double) { return radius; };
}

Width tapering(double from, double to) {
    return [=](double t) { return from + t * (to - from); };
}

Width between(std::vector<double> radii) {
    return [radii = std::move(radii)](double t) {
        const double place = t * static_cast<double>(radii.size() - 1);
        const std::size_t i = std::min(static_cast<std::size_t>(place), radii.size() - 2);
        const double u = place - static_cast<double>(i);
        return (1 - u) * radii[i] + u * radii[i + 1];
    };
}

Line straight(const Vec3& a, const Vec3& b) {
    return [=](double t) { return Vec3(a + t * (b - a)); };
}

Line through(std::vector<Vec3> points) {
    return [points = std::move(points)](double t) {
        const auto last = static_cast<int>(points.size()) - 1;
        const int i = std::clamp(static_cast<int>(t * last), 0, last - 1);
        const double u = t * last - i;
        const auto at = [&](int k) -> Vec3 {
            if (k < 0) return 2 * points.front() - points[1];
            if (k > last) return 2 * points.back() - points[static_cast<std::size_t>(last - 1)];
            return points[static_cast<std::size_t>(k)];
        };
        const Vec3 a = at(i - 1), b = at(i), c = at(i + 1), d = at(i + 2);
        return Vec3(b + u / 2 * (c - a + u * (2 * a - 5 * b + 4 * c - d + u * (3 * (b - c) + d - a))));
    };
}

TubeStroke trace(const Line& line, const Width& radius, const std::vector<double>& stops) {
    TubeStroke stroke;
    for (const double t : parameters(line, radius, stops)) {
        stroke.line.push_back(line(t));
        stroke.radii.push_back(radius(t));
    }
    if ((stroke.line.front() - stroke.line.back()).norm() < 1e-9) stroke.line.back() = stroke.line.front();
    return stroke;
}

TubeStroke trace_flat(const Line& line, const Width& radius, double aspect, const Line& wide) {
    TubeStroke stroke;
    stroke.aspect = aspect;
    for (const double t : parameters(line, radius, {})) {
        constexpr double h = 1e-4;
        const Vec3 tangent = (line(std::min(t + h, 1.0)) - line(std::max(t - h, 0.0))).normalized();
        const Vec3 side = wide(t);
        stroke.line.push_back(line(t));
        stroke.radii.push_back(radius(t));
        stroke.wide.push_back((side - side.dot(tangent) * tangent).normalized());
    }
    return stroke;
}

TubeStroke soft(TubeStroke stroke) {
    stroke.blend = soft_blend * *std::min_element(stroke.radii.begin(), stroke.radii.end());
    return stroke;
}

Vec3 joint_near(const TubeStroke& stroke, const Vec3& place) {
    return *std::min_element(stroke.line.begin(), stroke.line.end(), [&place](const Vec3& a, const Vec3& b) {
        return (a - place).squaredNorm() < (b - place).squaredNorm();
    });
}

double uniform(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

} // namespace skelgen::synth
