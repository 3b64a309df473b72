#include <skelgen/core/geometry.hpp>
#include <skelgen/curve/impl/meeting_axes.hpp>

#include <cmath>
#include <numbers>

#include "catch.hpp"
#include "curve/branched_lines.hpp"
#include "curve/unit_body.hpp"
#include "shapes.hpp"

using namespace skelgen;
using namespace skelgen::core;
using namespace skelgen::curve;
using namespace skelgen::test;

namespace {

constexpr double spacing = 0.03;

/// The axes of three_tubes(), with their junction somewhere else: it meets the axes again within a third of the way.
BranchedCurve<double> axes_from(const Vec3& junction) {
    const auto ends = three_tube_ends();
    BranchedCurve<double> out{{junction, ends[0], ends[1], ends[2]}, {}};
    for (int b = 0; b < 3; ++b) {
        const Vec3& end = ends[static_cast<std::size_t>(b)];
        out.branches.push_back({0, b + 1, line_through({junction, 0.35 * end, end}, spacing), {}});
    }
    return out;
}

/// Two branches that leave a knot at an angle.
BranchedCurve<double> angle(double radians) {
    return straight_branches({{0, 0, 0}, {1, 0, 0}, {std::cos(radians), std::sin(radians), 0}}, {{0, 1}, {0, 2}},
                             spacing);
}

} // namespace

TEST_CASE("the axes of three tubes meet where they were made to, wherever the knot is") {
    const Body<double> body = body_of(three_tubes());
    for (const Vec3& junction : {Vec3(0, 0, 0), Vec3(0.01, 0, -0.015), Vec3(-0.015, 0.01, 0.01)}) {
        const BranchedCurve<double> curve = axes_from(junction);
        const PlacesOfKnots<double> places =
            meeting_axes(curve, sections_of(curve, body, reach_in_spacings * spacing), body, 0.04);
        REQUIRE(places.size() == 4);
        REQUIRE(places[0].has_value());
        CHECK(places[0]->norm() < 0.015);
        for (std::size_t end = 1; end < 4; ++end) CHECK_FALSE(places[end].has_value());
    }
}

TEST_CASE("axes that pass by each other do not meet") {
    // The third tube begins a whole radius beside the first two, and goes away to that side.
    const double radius = 0.15;
    const std::vector<std::array<Vec3, 2>> segments{{Vec3(0, 0, -1), Vec3(0, 0, 1)},
                                                    {Vec3(0, radius, 0), Vec3(1, radius, 0)}};
    const Body<double> body = body_of(tubes(segments, radius, 0.04));
    BranchedCurve<double> curve{{{0, 0, 0}, {0, 0, -1}, {0, 0, 1}, {1, radius, 0}}, {}};
    curve.branches.push_back({0, 1, line_through({curve.knots[0], curve.knots[1]}, spacing), {}});
    curve.branches.push_back({0, 2, line_through({curve.knots[0], curve.knots[2]}, spacing), {}});
    curve.branches.push_back({0, 3, line_through({curve.knots[0], Vec3(0.2, radius, 0), curve.knots[3]}, spacing), {}});
    CHECK_FALSE(meeting_axes(curve, sections_of(curve, body, reach_in_spacings * spacing), body, 0.04)[0].has_value());
}

TEST_CASE("tubes part at the cotangent of half their angle, and a bit") {
    constexpr double right_angle = std::numbers::pi / 2;
    const double ball = 0.1, square = own_distance(angle(right_angle), 0, false, ball);
    CHECK(square > ball);
    CHECK(square < 1.5 * ball);
    for (const double radians : {0.6, 0.9, 1.2})
        CHECK(own_distance(angle(radians), 1, false, ball) == Approx(square / std::tan(radians / 2)));
    for (const double radians : {1.8, 2.4, 3.1}) CHECK(own_distance(angle(radians), 0, false, ball) == square);
    CHECK(own_distance(angle(0.01), 0, false, ball) < 10 * ball); // however small the angle
}
