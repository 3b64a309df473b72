#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <random>

#include <skelgen/synth/tubes.hpp>

#include "primitives.hpp"

namespace skelgen::synth {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double spacing = 0.25;   ///< of the points of a line, in radii
constexpr double soft_blend = 0.5; ///< in radii of the thinner tube: how far a joint of two tubes is rounded off
constexpr int finest_steps = 400;  ///< in which lengths along a line are measured

using Line = std::function<Vec3(double)>; ///< over 0 to 1
using Width = std::function<double(double)>;
using Strokes = std::vector<TubeStroke>;

Width even(double radius) {
    return [=](double) { return radius; };
}

Width tapering(double from, double to) {
    return [=](double t) { return from + t * (to - from); };
}

Line straight(const Vec3& a, const Vec3& b) {
    return [=](double t) { return Vec3(a + t * (b - a)); };
}

/// A smooth line through the points (Catmull and Rom's spline), each at a multiple of 1 / (n - 1).
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

TubeStroke trace(const Line& line, const Width& radius, const std::vector<double>& stops = {}) {
    TubeStroke stroke;
    for (const double t : parameters(line, radius, stops)) {
        stroke.line.push_back(line(t));
        stroke.radii.push_back(radius(t));
    }
    if ((stroke.line.front() - stroke.line.back()).norm() < 1e-9) stroke.line.back() = stroke.line.front();
    return stroke;
}

/// A tube with elliptical sections; `wide` is made perpendicular to the line.
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

/// The point of a tube's line that is nearest to a place: where others can be joined to it.
Vec3 joint_near(const TubeStroke& stroke, const Vec3& place) {
    return *std::min_element(stroke.line.begin(), stroke.line.end(), [&place](const Vec3& a, const Vec3& b) {
        return (a - place).squaredNorm() < (b - place).squaredNorm();
    });
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

double uniform(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

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
