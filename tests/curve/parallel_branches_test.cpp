#include <algorithm>

#include <skelgen/core/geometry.hpp>
#include <skelgen/curve/impl/parallel_branches.hpp>

#include "catch.hpp"
#include "curve/branched_lines.hpp"
#include "curve/curve_expectations.hpp"
#include "curve/unit_body.hpp"
#include "shapes.hpp"

using namespace skelgen;
using namespace skelgen::core;
using namespace skelgen::curve;
using namespace skelgen::test;

namespace {

constexpr double radius = 0.2, spacing = 0.05;

/// From the knot (0, 0, 1) of capsule(radius, 4) one branch down and two up beside the axis; these end apart.
BranchedCurve<double> fork(double apart) {
    const Vec3 knot(0, 0, 1), left(-0.15, 0, 3), right(0.15, 0, 3);
    BranchedCurve<double> out{{knot, {0, 0, -0.1}, left, right}, {}};
    out.branches.push_back({0, 1, line_through({knot, out.knots[1]}, spacing), {0, 1, 4}});
    out.branches.push_back(
        {0, 2, line_through({knot, {-apart / 2, 0, 1.1}, {-apart / 2, 0, 2.5}, left}, spacing), {0, 2, 5}});
    out.branches.push_back(
        {3, 0, line_through({right, {apart / 2, 0, 2.5}, {apart / 2, 0, 1.1}, knot}, spacing), {0, 3, 6}});
    return out;
}

CurveSkeleton<double> joined(const BranchedCurve<double>& branched) { return join_branches(branched).curve; }

} // namespace

TEST_CASE("two lines that run side by side from one knot become one up to where they part") {
    const Body<double> body = body_of(capsule(radius, 4));
    const BranchedCurve<double> before = fork(0.04), after = merge_parallel_branches(before, body);
    CHECK(after.branches.size() == 3);
    const std::vector<Vec3> junctions = knots_of_degree(after, 3);
    REQUIRE(junctions.size() == 1);
    INFO("junction at " << junctions[0].transpose());
    CHECK(junctions[0][2] > 2.4);
    CHECK(junctions[0][2] < 2.9);
    CHECK(std::abs(junctions[0][0]) < 0.01);
    const std::vector<Vec3> ends = knots_of_degree(after, 1);
    CHECK(ends.size() == 3);
    for (const Vec3& end : knots_of_degree(before, 1)) CHECK(distance_to_nearest(end, ends) == 0);
    CHECK(total_length(after) < total_length(before) - 1.3);
    CHECK(cycles(joined(after)) == 0);
    CHECK(pieces(joined(after)) == 1);
    // The common part comes from both.
    CHECK(std::any_of(after.branches.begin(), after.branches.end(), [](const Branch<double>& branch) {
        return branch.origins == std::vector<int>{0, 1, 2, 3, 4, 5, 6};
    }));
    for (const Branch<double>& branch : after.branches) {
        CHECK(point(branch.line, 0) == after.knots[static_cast<std::size_t>(branch.from)]);
        CHECK(point(branch.line, branch.line.rows() - 1) == after.knots[static_cast<std::size_t>(branch.to)]);
        CHECK(std::is_sorted(branch.origins.begin(), branch.origins.end()));
    }
}

TEST_CASE("lines farther apart than half the radius, and lines at a right angle, stay apart") {
    const Body<double> body = body_of(capsule(radius, 4));
    const BranchedCurve<double> wide = fork(0.2);
    CHECK(merge_parallel_branches(wide, body).branches.size() == 3);
    CHECK(joined(merge_parallel_branches(wide, body)).nodes == joined(wide).nodes);

    const Body<double> ball = body_of(sphere(1, 3));
    const BranchedCurve<double> cross =
        straight_branches({{0, 0, 0}, {0.9, 0, 0}, {0, 0.9, 0}, {0, 0, 0.9}}, {{0, 1}, {0, 2}, {3, 0}}, spacing);
    CHECK(joined(merge_parallel_branches(cross, ball)).nodes == joined(cross).nodes);
    CHECK(joined(merge_parallel_branches(cross, ball)).edges == joined(cross).edges);
}

TEST_CASE("lines side by side over less than the radius stay apart") {
    const Body<double> body = body_of(capsule(radius, 4));
    const Vec3 knot(0, 0, 2);
    const BranchedCurve<double> fork =
        straight_branches({knot, {0, 0, 0}, {-0.15, 0, 2.3}, {0.15, 0, 2.3}}, {{0, 1}, {0, 2}, {0, 3}}, 0.02);
    CHECK(joined(merge_parallel_branches(fork, body)).nodes == joined(fork).nodes);
}

TEST_CASE("a loop of two lines side by side keeps its cycle") {
    const Body<double> body = body_of(capsule(radius, 4));
    const Vec3 low(0, 0, 1), high(0, 0, 3);
    BranchedCurve<double> loop = straight_branches({low, high, {0, 0, 0}, {0, 0, 4}}, {{0, 2}, {1, 3}}, spacing);
    loop.branches.push_back({0, 1, line_through({low, {0.02, 0, 1.1}, {0.02, 0, 2.9}, high}, spacing), {0, 1, 6}});
    loop.branches.push_back({0, 1, line_through({low, {-0.02, 0, 1.1}, {-0.02, 0, 2.9}, high}, spacing), {0, 1, 7}});
    const BranchedCurve<double> after = merge_parallel_branches(loop, body);
    REQUIRE(cycles(joined(loop)) == 1);
    CHECK(cycles(joined(after)) == 1);
    CHECK(knots_of_degree(after, 1).size() == 2);
    CHECK(pieces(joined(after)) == 1);
}

TEST_CASE("of four lines from a knot two pairs merge, and all ends stay") {
    const Body<double> body = body_of(capsule(radius, 4));
    BranchedCurve<double> star{{{0, 0, 2}}, {}};
    for (const double side : {-1.0, 1.0})
        for (const double up : {-1.0, 1.0}) {
            const Vec3 tip(0.15 * side, 0, 2 + 2 * up);
            const int end = static_cast<int>(star.knots.size());
            star.knots.push_back(tip);
            star.branches.push_back(
                {0,
                 end,
                 line_through({star.knots[0], {0.02 * side, 0, 2 + 0.1 * up}, {0.02 * side, 0, 2 + 1.5 * up}, tip},
                              spacing),
                 {0, end}});
        }
    const BranchedCurve<double> after = merge_parallel_branches(star, body);
    CHECK(knots_of_degree(after, 1).size() == 4);
    CHECK(knots_of_degree(after, 3).size() == 2);
    CHECK(knots_of_degree(after, 4).empty());
    CHECK(cycles(joined(after)) == 0);
    CHECK(pieces(joined(after)) == 1);
}
