#include <algorithm>
#include <array>
#include <cmath>

#include <skelgen/synth/tubes.hpp>

#include "lines.hpp"

namespace skelgen::synth {
namespace {

using Strokes = std::vector<TubeStroke>;

/// Straight, `degrees` of a circle, straight again.
Line bent(double degrees, double circle, double leg) {
    const double angle = degrees * pi / 180, length = 2 * leg + circle * angle;
    return [=](double t) {
        const double s = t * length - leg, turned = std::clamp(s / circle, 0.0, angle);
        const double before = std::min(s, 0.0), after = std::max(0.0, s - circle * angle);
        return Vec3(circle * std::sin(turned) + before + after * std::cos(angle),
                    circle * (1 - std::cos(turned)) + after * std::sin(angle), 0);
    };
}

Line helix(double turns) {
    constexpr double circle = 0.40, pitch = 0.45;
    return [=](double t) {
        const double angle = 2 * pi * turns * t;
        return Vec3(circle * std::cos(angle), circle * std::sin(angle), pitch * turns * t);
    };
}

Vec3 trefoil(double t) {
    const double a = 2 * pi * t;
    return 0.27 * Vec3(std::sin(a) + 2 * std::sin(2 * a), std::cos(a) - 2 * std::cos(2 * a), -std::sin(3 * a));
}

TubePlan plan(const char* name, Strokes strokes, int ends, int cycles) {
    TubePlan result;
    result.name = name, result.strokes = std::move(strokes), result.ends = ends, result.cycles = cycles;
    return result;
}

TubePlan with_faces(TubePlan plan, int faces) {
    plan.faces = faces;
    return plan;
}

TubePlan fine(TubePlan plan) {
    plan.fine = true;
    return plan;
}

Vec3 in_plane(double degrees) { return {std::cos(degrees * pi / 180), std::sin(degrees * pi / 180), 0}; }

/// Arms from the origin into these directions, each thinner than the one before and tapering.
Strokes star(const std::vector<Vec3>& directions) {
    Strokes strokes;
    double radius = 0.13;
    for (const Vec3& direction : directions) {
        strokes.push_back(
            soft(trace(straight(Vec3::Zero(), 0.95 * direction.normalized()), tapering(radius, 0.75 * radius))));
        radius -= 0.008;
    }
    return strokes;
}

Strokes ladder(int rungs) {
    constexpr double step = 0.5, half_width = 0.32, rail = 0.085, rung = 0.06;
    const double height = step * (rungs + 1);
    Strokes strokes;
    for (const double side : {half_width, -half_width})
        strokes.push_back(trace(straight({side, 0, 0}, {side, 0, height}), even(rail)));
    for (int k = 1; k <= rungs; ++k) {
        const Vec3 from = joint_near(strokes[0], {half_width, 0, step * k});
        const Vec3 to = joint_near(strokes[1], {-half_width, 0, step * k});
        strokes.push_back(soft(trace(straight(from, to), even(rung))));
    }
    return strokes;
}

/// A branch and what grows from its end: two branches that spread in the plane of `spread`.
void grow(Strokes& strokes, const Vec3& from, const Vec3& direction, const Vec3& spread, int level) {
    constexpr std::array<double, 5> radii{0.13, 0.095, 0.07, 0.05, 0.042}, lengths{0.9, 0.75, 0.6, 0.5};
    const auto i = static_cast<std::size_t>(level);
    const Vec3 to = from + lengths[i] * direction;
    strokes.push_back(soft(trace(straight(from, to), tapering(radii[i], radii[i + 1]))));
    if (level == 3) return;
    const Vec3 other = direction.cross(spread).normalized();
    for (const double side : {38.0, -34.0}) {
        const double angle = side * pi / 180;
        grow(strokes, to, std::cos(angle) * direction + std::sin(angle) * spread,
             level == 0 ? other : Vec3(direction.cross(spread).normalized()), level + 1);
    }
}

Strokes tree() {
    Strokes strokes;
    grow(strokes, Vec3::Zero(), Vec3::UnitZ(), Vec3::UnitX(), 0);
    return strokes;
}

Strokes y_branching() {
    return {trace(straight({0, 0, -0.9}, Vec3::Zero()), tapering(0.14, 0.12)),
            soft(trace(straight(Vec3::Zero(), {0.6, 0, 0.75}), tapering(0.12, 0.09))),
            soft(trace(straight(Vec3::Zero(), {-0.6, 0.1, 0.7}), tapering(0.11, 0.08)))};
}

Strokes t_branching() {
    return {trace(straight({-0.9, 0, 0}, {0.9, 0, 0}), even(0.11), {0.5}),
            soft(trace(straight(Vec3::Zero(), {0, 0, 0.9}), even(0.09)))};
}

Strokes cross() {
    return {trace(straight({-0.9, 0, 0}, {0.9, 0, 0}), even(0.11), {0.5}),
            soft(trace(straight({0, -0.8, 0}, {0, 0.8, 0}), even(0.10), {0.5}))};
}

Strokes fork() {
    return {
        trace(straight({0, 0, -0.9}, Vec3::Zero()), even(0.14)),
        soft(trace(through({{0, 0, 0}, {0.26, 0, 0.16}, {0.34, 0, 0.45}, {0.36, 0, 0.95}}), tapering(0.13, 0.10))),
        soft(trace(through({{0, 0, 0}, {-0.24, 0, 0.18}, {-0.33, 0, 0.45}, {-0.36, 0, 0.9}}), tapering(0.06, 0.05)))};
}

/// Trunk along y, z up; the legs start in the trunk's axis.
Strokes animal() {
    const TubeStroke trunk = trace(through({{0, -0.45, 0.75}, {0, 0, 0.70}, {0, 0.45, 0.75}}),
                                   [](double t) { return 0.17 + 0.02 * std::cos(2 * pi * t); });
    Strokes strokes{trunk};
    strokes.push_back(soft(trace(through({trunk.line.front(), {0, -0.72, 1.0}, {0, -0.88, 1.2}, {0, -1.15, 1.2}}),
                                 [](double t) { return 0.11 - 0.02 * std::sin(pi * t); })));
    strokes.push_back(soft(
        trace(through({trunk.line.back(), {0, 0.75, 0.85}, {0, 1.0, 0.7}, {0, 1.15, 0.4}}), tapering(0.07, 0.04))));
    for (const double side : {1.0, -1.0}) {
        const Vec3 shoulder = joint_near(trunk, {0, -0.36, 0.74}), hip = joint_near(trunk, {0, 0.36, 0.74});
        strokes.push_back(soft(
            trace(through({shoulder, {side * 0.17, -0.38, 0.5}, {side * 0.18, -0.36, 0}}), tapering(0.09, 0.055))));
        strokes.push_back(
            soft(trace(through({hip, {side * 0.18, 0.36, 0.5}, {side * 0.19, 0.46, 0.25}, {side * 0.19, 0.40, 0}}),
                       tapering(0.10, 0.055))));
    }
    return strokes;
}

/// Wrist at the origin, z towards the fingers, x towards the thumb.
Strokes hand() {
    const TubeStroke palm = trace_flat(straight(Vec3::Zero(), {0, 0, 0.55}), tapering(0.10, 0.08), 1.8,
                                       [](double) { return Vec3::UnitX(); });
    Strokes strokes{palm};
    const auto finger = [&strokes](const Vec3& from, const Vec3& knuckle, double degrees, double length,
                                   double radius) {
        const Vec3 direction(std::sin(degrees * pi / 180), 0, std::cos(degrees * pi / 180));
        const Vec3 tip = knuckle + length * direction;
        strokes.push_back(
            soft(trace(through({from, knuckle, (knuckle + tip) / 2, tip}), tapering(radius, 0.85 * radius))));
    };
    finger(palm.line.back(), {0.19, 0, 0.72}, 21, 0.62, 0.056);
    finger(palm.line.back(), {0.065, 0, 0.77}, 7, 0.72, 0.060);
    finger(palm.line.back(), {-0.065, 0, 0.77}, -7, 0.66, 0.058);
    finger(palm.line.back(), {-0.19, 0, 0.72}, -21, 0.52, 0.052);
    finger(joint_near(palm, {0, 0, 0.15}), {0.24, 0, 0.32}, 55, 0.50, 0.065);
    return strokes;
}

std::vector<TubePlan> unmoved_plans() {
    const Line axis = straight({0, 0, -1}, {0, 0, 1});
    const auto side = [](double degrees) { return [=](double t) { return in_plane(degrees * t); }; };
    std::vector<TubePlan> plans;
    const auto single = [&plans](const char* name, TubeStroke stroke, int ends = 2, int cycles = 0) {
        plans.push_back(plan(name, {std::move(stroke)}, ends, cycles));
    };
    single("straight", trace(axis, even(0.12)));
    single("bent-45", trace(bent(45, 0.40, 0.80), even(0.12)));
    single("bent-90", trace(bent(90, 0.40, 0.75), even(0.12)));
    single("bent-135", trace(bent(135, 0.38, 0.75), even(0.11)));
    single("bent-180", trace(bent(180, 0.35, 0.75), even(0.10)));
    single("tapering", trace(axis, tapering(0.20, 0.06)));
    single("tapering-bent", trace(bent(100, 0.45, 0.70), tapering(0.17, 0.06)));
    single("bulging", trace(axis, [](double t) { return 0.13 + 0.04 * std::sin(4 * pi * t); }));
    single("s-curve", trace([](double t) { return Vec3(2 * t, 0.32 * std::sin(2 * pi * t), 0); }, even(0.10)));
    single("helix-2", trace(helix(2), even(0.09)));
    single("helix-3", trace(helix(3), tapering(0.10, 0.07)));
    single("trefoil", trace(trefoil, even(0.09)), 0, 1);
    single("ring", trace([](double t) { return Vec3(0.55 * in_plane(360 * t)); }, even(0.14)), 0, 1);
    plans.push_back(plan("branching-y", y_branching(), 3, 0));
    plans.push_back(plan("branching-t", t_branching(), 3, 0));
    plans.push_back(plan("cross", cross(), 4, 0));
    plans.push_back(fine(with_faces(plan("tree", tree(), 9, 0), 12000)));
    plans.push_back(plan("star-4", star({{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}), 4, 0));
    plans.push_back(plan("star-5", star({in_plane(0), in_plane(120), in_plane(240), {0, 0.3, 1}, {0.3, 0, -1}}), 5, 0));
    plans.push_back(
        plan("star-6", star({{1, 0, 0}, {-1, 0, 0.2}, {0, 1, 0}, {0.2, -1, 0}, {0, 0, 1}, {0, 0.2, -1}}), 6, 0));
    plans.push_back(plan("ladder-2", ladder(2), 4, 1));
    plans.push_back(with_faces(plan("ladder-3", ladder(3), 4, 2), 10000));
    plans.push_back(with_faces(plan("ladder-4", ladder(4), 4, 3), 12000));
    single("ellipse-1.5", trace_flat(axis, even(0.12), 1.5, side(0)));
    single("ellipse-2", trace_flat(axis, tapering(0.11, 0.08), 2, side(0)));
    single("ellipse-twisted", trace_flat(axis, even(0.10), 2, side(150)));
    single("ellipse-bent", trace_flat(bent(90, 0.5, 0.7), even(0.10), 1.8, [](double) { return Vec3::UnitZ(); }));
    plans.push_back(plan("fork", fork(), 3, 0));
    plans.push_back(fine(with_faces(plan("animal", animal(), 6, 0), 10000)));
    plans.push_back(fine(with_faces(plan("hand", hand(), 6, 0), 10000)));
    return plans;
}

/// Every rotation is as likely as every other.
Mat3 random_rotation(std::mt19937_64& random) {
    const double u = uniform(random), a = 2 * pi * uniform(random), b = 2 * pi * uniform(random);
    const double s = std::sqrt(1 - u), c = std::sqrt(u);
    return Eigen::Quaterniond(c * std::cos(b), s * std::sin(a), s * std::cos(a), c * std::sin(b)).toRotationMatrix();
}

} // namespace

std::vector<TubePlan> tube_plans(std::uint64_t seed) {
    std::vector<TubePlan> plans = unmoved_plans();
    std::mt19937_64 random(seed);
    for (TubePlan& each : plans) {
        const Mat3 rotation = random_rotation(random);
        const double x = uniform(random), y = uniform(random), z = uniform(random);
        for (TubeStroke& stroke : each.strokes) {
            for (Vec3& place : stroke.line) place = rotation * place + Vec3(x, y, z);
            for (Vec3& direction : stroke.wide) direction = rotation * direction;
        }
    }
    return plans;
}

} // namespace skelgen::synth
