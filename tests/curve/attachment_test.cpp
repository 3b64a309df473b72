#include <algorithm>

#include <skelgen/core/geometry.hpp>
#include <skelgen/curve/impl/attachment.hpp>

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

constexpr double spacing = 0.03;

/// The axes of three_tubes(); the first two meet at the origin, the third leaves the first one `down` its way.
BranchedCurve<double> axes_joined(double down) {
    const auto ends = three_tube_ends();
    const Vec3 joint = down * ends[0];
    BranchedCurve<double> out{{joint, ends[0], ends[1], ends[2]}, {}};
    out.branches.push_back({0, 1, line_through({joint, ends[0]}, spacing), {0, 1, 4}});
    out.branches.push_back({0, 2, line_through({joint, Vec3::Zero(), ends[1]}, spacing), {0, 2, 5}});
    out.branches.push_back({3, 0, line_through({ends[2], 0.3 * ends[2], joint}, spacing), {0, 3, 6}});
    return out;
}

void check_same_shape(const BranchedCurve<double>& before, const BranchedCurve<double>& after) {
    const CurveSkeleton<double> a = join_branches(before).curve, b = join_branches(after).curve;
    CHECK(knots_of_degree(after, 2).empty());
    CHECK(cycles(b) == cycles(a));
    CHECK(pieces(b) == pieces(a));
    check_is_curve(b, 0);
    const std::vector<Vec3> ends = knots_of_degree(after, 1);
    CHECK(ends.size() == knots_of_degree(before, 1).size());
    for (const Vec3& end : knots_of_degree(before, 1)) CHECK(distance_to_nearest(end, ends) == 0);
    for (const Branch<double>& branch : after.branches) {
        CHECK(point(branch.line, 0) == after.knots[static_cast<std::size_t>(branch.from)]);
        CHECK(point(branch.line, branch.line.rows() - 1) == after.knots[static_cast<std::size_t>(branch.to)]);
    }
}

} // namespace

TEST_CASE("a branch that leaves another one too far down comes to leave it where its tube does", "[slow]") {
    const Body<double> body = body_of(three_tubes());
    for (const double down : {0.2, 0.3}) {
        const BranchedCurve<double> before = axes_joined(down), after = reattach_branches(before, {}, body, spacing);
        check_same_shape(before, after);
        const std::vector<Vec3> junctions = knots_of_degree(after, 3);
        REQUIRE(junctions.size() == 1);
        INFO("junction at " << junctions[0].transpose());
        CHECK(junctions[0].norm() < 0.8 * down);
        CHECK(total_length(after) < total_length(before));
    }
}

TEST_CASE("branches that meet where their axes do keep their ends and their junction") {
    const Body<double> body = body_of(three_tubes());
    const BranchedCurve<double> before = axes_joined(0), after = reattach_branches(before, {}, body, spacing);
    check_same_shape(before, after);
    const std::vector<Vec3> junctions = knots_of_degree(after, 3);
    REQUIRE(junctions.size() == 1);
    CHECK(junctions[0].norm() < 0.12);
}

TEST_CASE("a branch at a junction where axes are known to meet is left there") {
    const Body<double> body = body_of(three_tubes());
    const BranchedCurve<double> before = axes_joined(0.3);
    const BranchedCurve<double> after = reattach_branches(before, {Vec3(Vec3::Zero())}, body, spacing);
    REQUIRE(after.branches.size() == before.branches.size());
    for (std::size_t b = 0; b < after.branches.size(); ++b) CHECK(after.branches[b].line == before.branches[b].line);
}

TEST_CASE("a cycle stays one when a branch at it is joined anew") {
    const Body<double> body = body_of(three_tubes());
    const auto ends = three_tube_ends();
    BranchedCurve<double> before = axes_joined(0.3);
    // A loop in the second tube.
    const Vec3 low = 0.5 * ends[1], high = 0.9 * ends[1], side(0, 0.04, 0);
    const int first = static_cast<int>(before.knots.size());
    before.knots.insert(before.knots.end(), {low, high});
    before.branches[1] = {0, first, line_through({before.knots[0], Vec3::Zero(), low}, spacing), {0, 2, 5}};
    for (const double sign : {-1.0, 1.0})
        before.branches.push_back(
            {first, first + 1, line_through({low, (low + high) / 2 + sign * side, high}, spacing), {2, 5}});
    before.branches.push_back({first + 1, 2, line_through({high, ends[1]}, spacing), {2, 5}});
    REQUIRE(cycles(join_branches(before).curve) == 1);
    check_same_shape(before, reattach_branches(before, {}, body, spacing));
}

TEST_CASE("a curve without junctions stays as it is") {
    const Body<double> body = body_of(capsule(0.2, 4));
    const BranchedCurve<double> line = straight_branches({{0, 0, 0}, {0.1, 0, 4}}, {{0, 1}}, 0.1);
    const BranchedCurve<double> after = reattach_branches(line, {}, body, 0.1);
    REQUIRE(after.branches.size() == 1);
    CHECK(after.branches[0].line == line.branches[0].line);
    CHECK(after.knots == line.knots);
}

TEST_CASE("a branch is not joined to the end of another one, which would be an end no longer") {
    const Body<double> body = body_of(three_tubes());
    const auto ends = three_tube_ends();
    const Vec3 joint = 0.2 * ends[0];
    // A short branch goes on from the first tube's axis to where the third one's begins.
    BranchedCurve<double> before = straight_branches({joint, ends[0], Vec3::Zero()}, {{2, 0}, {0, 1}}, spacing);
    before.knots.push_back(ends[2]);
    before.branches.push_back({0, 3, line_through({joint, 0.3 * ends[2], ends[2]}, spacing), {0, 3, 6}});
    check_same_shape(before, reattach_branches(before, {}, body, spacing));
}
