#include <skelgen/core/geometry.hpp>
#include <skelgen/curve/impl/axis_ends.hpp>

#include "catch.hpp"
#include "curve/branched_lines.hpp"
#include "curve/unit_body.hpp"
#include "shapes.hpp"

using namespace skelgen;
using namespace skelgen::core;
using namespace skelgen::curve;
using namespace skelgen::test;

namespace {

constexpr double radius = 0.2;

BranchedCurve<double> on_axes(const BranchedCurve<double>& branched, const Body<double>& body) {
    return ends_on_axes(branched, sections_of(branched, body, 0.2), body);
}

/// One branch along the axis of capsule(radius, 4) whose ends lie off it, by `bend`.
BranchedCurve<double> bent_at_ends(double low, double high, const Vec3& bend) {
    const Vec3 first = Vec3(0, 0, low) + bend, last = Vec3(0, 0, high) - bend, up(0, 0, 0.08);
    const Points<double> line = line_through({first, Vec3(0, 0, low) + up, Vec3(0, 0, high) - up, last}, 0.02);
    return {{first, last}, {{0, 1, line, {0, 1, 2}}}};
}

} // namespace

TEST_CASE("ends that lie off the axis come to lie on it, just inside the poles") {
    const Body<double> body = body_of(capsule(radius, 4));
    for (const Vec3& bend : {Vec3(0, 0, 0), Vec3(0.05, 0.03, 0), Vec3(-0.06, 0, 0)})
        for (const double out_by : {-0.1, 0.1}) {
            const BranchedCurve<double> bent = bent_at_ends(-out_by, 4 + out_by, bend), placed = on_axes(bent, body);
            REQUIRE(placed.branches.size() == 1);
            CHECK(placed.branches[0].line.rows() == bent.branches[0].line.rows());
            CHECK(placed.branches[0].origins == bent.branches[0].origins);
            for (const std::size_t k : {std::size_t{0}, std::size_t{1}}) {
                const Vec3 pole(0, 0, k == 0 ? -radius : 4 + radius), end = placed.knots[k];
                INFO("end at " << end.transpose());
                CHECK(end.head<2>().norm() < 0.03 * radius);
                CHECK((end - pole).norm() < 0.1 * radius);
                CHECK(end[2] > -radius);
                CHECK(end[2] < 4 + radius);
            }
            const Points<double>& line = placed.branches[0].line;
            CHECK(point(line, 0) == placed.knots[0]);
            CHECK(point(line, line.rows() - 1) == placed.knots[1]);
            CHECK(line.leftCols<2>().rowwise().norm().maxCoeff() < 0.03 * radius);
            for (Eigen::Index i = 1; i < line.rows(); ++i) CHECK(line(i, 2) > line(i - 1, 2));
        }
}

TEST_CASE("a branch that runs the other way ends in the same places") {
    const Body<double> body = body_of(capsule(radius, 4));
    const BranchedCurve<double> bent = bent_at_ends(-0.1, 4.1, {0.05, 0.03, 0});
    BranchedCurve<double> backwards{{bent.knots[1], bent.knots[0]}, bent.branches};
    backwards.branches[0].line = bent.branches[0].line.colwise().reverse().eval();
    const BranchedCurve<double> a = on_axes(bent, body), b = on_axes(backwards, body);
    CHECK((a.knots[0] - b.knots[1]).norm() < 1e-2 * radius);
    CHECK((a.knots[1] - b.knots[0]).norm() < 1e-2 * radius);
}

TEST_CASE("junctions and rings stay where they are") {
    const Body<double> body = body_of(three_tubes());
    const auto ends = three_tube_ends();
    const BranchedCurve<double> star =
        straight_branches({Vec3::Zero(), ends[0], ends[1], ends[2]}, {{0, 1}, {2, 0}, {0, 3}}, 0.03);
    const BranchedCurve<double> placed = on_axes(star, body);
    CHECK(placed.knots[0] == Vec3::Zero());
    for (std::size_t k = 1; k < 4; ++k) {
        // The tubes end in half spheres around their ends.
        const Vec3 axis = ends[k - 1].normalized(), tip = ends[k - 1] + 0.12 * axis;
        INFO("end at " << placed.knots[k].transpose() << ", tip at " << tip.transpose());
        CHECK((placed.knots[k] - tip).norm() < 0.2 * 0.12);
        CHECK(winding_number(body.mesh, placed.knots[k]) > 0.5);
    }

    const Body<double> ring_body = body_of(torus(1, 0.25));
    std::vector<Vec3> circle;
    for (int i = 0; i <= 40; ++i) circle.emplace_back(std::cos(2 * pi * i / 40), std::sin(2 * pi * i / 40), 0);
    circle.back() = circle.front();
    const BranchedCurve<double> ring{{circle[0]}, {{0, 0, make_mesh(circle, {}).vertices, {0, 1}}}};
    CHECK(on_axes(ring, ring_body).branches[0].line == ring.branches[0].line);
}

TEST_CASE("a branch whose sections say nothing stays as it is") {
    const Body<double> body = body_of(capsule(radius, 4));
    const BranchedCurve<double> bent = bent_at_ends(-0.1, 4.1, {0.05, 0.03, 0});
    std::vector<std::vector<BranchSection<double>>> none(1);
    none[0].resize(static_cast<std::size_t>(bent.branches[0].line.rows()));
    const BranchedCurve<double> placed = ends_on_axes(bent, none, body);
    CHECK(placed.branches[0].line == bent.branches[0].line);
    CHECK(placed.knots == bent.knots);
}
