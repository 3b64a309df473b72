#pragma once

// A shin and a foot of tubes, whose toes are known: a left one, its length from the ball to the end of the big toe 1.

#include <algorithm>
#include <vector>

#include <skelgen/core/kinematic_skeleton.hpp>

#include "shapes.hpp"

namespace skelgen::test {

/// A toe from the ball of the foot to the middle of its round end. The left foot: x to the person's right, y forwards,
/// z up; its length from the ball to the end of the big toe is 1.
struct Toe {
    Vec3 base, end;
    double radius;

    [[nodiscard]] Vec3 tip() const { return end + radius * (end - base).normalized(); }
};

inline std::vector<Toe> five_toes() {
    return {{{0.32, 0.0, 0}, {0.34, 0.87, -0.02}, 0.13},
            {{0.10, 0.0, 0}, {0.04, 0.86, -0.02}, 0.10},
            {{-0.08, -0.06, 0}, {-0.20, 0.75, -0.02}, 0.095},
            {{-0.24, -0.14, 0}, {-0.41, 0.61, -0.02}, 0.09},
            {{-0.38, -0.24, 0}, {-0.58, 0.46, -0.02}, 0.085}};
}

/// Shin, instep and toes; in a shoe, all that is around the toes.
inline Mesh foot_of(const std::vector<Toe>& toes, bool is_shod = false) {
    struct Tube {
        Vec3 a, b;
        double radius;
    };
    std::vector<Tube> tubes{{{0.02, -1.7, 1.2}, {0.02, -1.7, 0.6}, 0.42}, {{0.02, -1.7, 0.6}, {0.02, -2, 0.1}, 0.3}};
    for (const double across : {-0.3, -0.1, 0.1, 0.3})
        tubes.push_back({{across / 2, -1.6, 0.45}, {across, 0.22 + 0.25 * (across - 0.3), 0.02}, 0.2});
    for (const Toe& toe : toes) tubes.push_back({toe.base, toe.end, toe.radius});
    if (is_shod) tubes.push_back({{0, 0, 0.05}, {0, 0.6, 0.05}, 0.62});
    const auto field = [&](const Vec3& p) {
        double least = 1;
        for (const Tube& tube : tubes) least = std::min(least, segment_distance(p, tube.a, tube.b) - tube.radius);
        return least;
    };
    return level_set(field, {-0.9, -2.4, -0.7}, {0.7, 1.4, 1.7}, 0.035);
}

/// What a skeleton says of such a leg.
inline KinematicSkeleton<double> leg_skeleton() {
    KinematicSkeleton<double> out;
    out.template_name = "human21";
    out.joints = {
        {"left_knee", -1, Vec3(0, -1.6, 7)}, {"left_ankle", 0, Vec3(0, -1.7, 0.8)}, {"left_foot", 1, Vec3(0.02, 0, 0)}};
    out.end_points.emplace_back("left_toe", Vec3(0.34, 1, -0.02));
    return out;
}

} // namespace skelgen::test
