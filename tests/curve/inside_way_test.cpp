#include <skelgen/curve/inside_way.hpp>

#include <array>
#include <vector>

#include <skelgen/core/geometry.hpp>

#include "branched_lines.hpp"
#include "catch.hpp"
#include "shapes.hpp"
#include "unit_body.hpp"

using namespace skelgen;
using namespace skelgen::curve;
using namespace skelgen::test;

namespace {

constexpr double spacing = 0.04, reach = 0.16;

/// Two legs, joined above or not.
Body<double> legs(bool joined) {
    std::vector<std::array<Vec3, 2>> segments{{Vec3(-0.3, 0, 0), Vec3(-0.3, 0, 1)}, {Vec3(0.3, 0, 1), Vec3(0.3, 0, 0)}};
    if (joined) segments.push_back({Vec3(-0.3, 0, 1), Vec3(0.3, 0, 1)});
    return body_of(tubes(segments, 0.1, 0.04));
}

/// One branch through these points.
BranchedCurve<double> branch_through(const std::vector<Vec3>& points) {
    return {{points.front(), points.back()}, {{0, 1, line_through(points, spacing), {}}}};
}

/// Up one leg, straight across to the other one, and down.
BranchedCurve<double> shortcut() {
    return branch_through({Vec3(-0.3, 0, 0.05), Vec3(-0.3, 0, 0.4), Vec3(0.3, 0, 0.4), Vec3(0.3, 0, 0.05)});
}

} // namespace

TEST_CASE("a branch that cuts across from limb to limb is led around inside") {
    const Body<double> body = legs(true);
    const BranchedCurve<double> curve = shortcut();
    const BranchedCurve<double> led = led_inside(curve, sections_of(curve, body, reach), balls_in(body));
    REQUIRE(led.branches.size() == 1);
    const Points<double>& line = led.branches[0].line;
    CHECK(core::point(line, 0) == curve.knots[0]);
    CHECK(core::point(line, line.rows() - 1) == curve.knots[1]);
    for (Eigen::Index i = 0; i < line.rows(); ++i) {
        INFO(line.row(i));
        CHECK(core::winding_number(body.mesh, core::point(line, i)) > 0.5);
    }
    CHECK(total_length(led) == Approx(0.95 + 0.6 + 0.95).epsilon(0.1));
}

TEST_CASE("a branch inside stays as it is, and one that no way inside replaces") {
    const Body<double> joined = legs(true), apart = legs(false);
    const BranchedCurve<double> inside = branch_through({Vec3(-0.3, 0, 0.05), Vec3(-0.3, 0, 0.9)});
    CHECK(led_inside(inside, sections_of(inside, joined, reach), balls_in(joined)).branches[0].line ==
          inside.branches[0].line);
    const BranchedCurve<double> across = shortcut();
    CHECK(led_inside(across, sections_of(across, apart, reach), balls_in(apart)).branches[0].line ==
          across.branches[0].line);
}
