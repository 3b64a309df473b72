#include <algorithm>
#include <cmath>

#include <skelgen/core/geometry.hpp>
#include <skelgen/curve/branch_centring.hpp>
#include <skelgen/curve/pruning.hpp>

#include "catch.hpp"
#include "curve/branched_lines.hpp"
#include "curve/curve_expectations.hpp"
#include "curve/throws.hpp"
#include "curve/unit_body.hpp"
#include "mesh_changes.hpp"
#include "shapes.hpp"

using namespace skelgen;
using namespace skelgen::core;
using namespace skelgen::curve;
using namespace skelgen::test;

namespace {

constexpr double radius = 0.2;

/// A line that swings to both sides of the axis of capsule(radius, 4), by half the radius.
BranchedCurve<double> zigzag() {
    std::vector<Vec3> points;
    for (int i = 0; i <= 10; ++i) points.emplace_back(i % 2 == 0 ? 0.1 : -0.1, i % 3 == 0 ? 0.05 : -0.05, 0.4 * i);
    return {{points.front(), points.back()}, {{0, 1, line_through(points, 0.1), {0, 1, 2}}}};
}

/// Branches along the axes of three_tubes(), all bent to one side between their ends.
BranchedCurve<double> bent_star() {
    const auto ends = three_tube_ends();
    BranchedCurve<double> star{{Vec3(0.03, 0.03, 0.02), ends[0], ends[1], ends[2]}, {}};
    for (int k = 1; k <= 3; ++k) {
        const Vec3 end = ends[static_cast<std::size_t>(k - 1)];
        star.branches.push_back(
            {0, k, line_through({star.knots[0], end / 2 + Vec3(0.04, 0.03, 0), end}, 0.05), {0, k, 3 + k}});
    }
    return star;
}

/// Largest distance from the axis of three_tubes() nearest to it of any point between these distances from the origin.
double off_axes(const BranchedCurve<double>& branched, double from, double to) {
    double worst = 0;
    for (const Branch<double>& branch : branched.branches)
        for (Eigen::Index i = 0; i < branch.line.rows(); ++i) {
            const Vec3 p = point(branch.line, i);
            if (p.norm() < from || p.norm() > to) continue;
            double least = 1;
            for (const Vec3& end : three_tube_ends())
                least = std::min(least, segment_distance(p, Vec3::Zero(), 2 * end));
            worst = std::max(worst, least);
        }
    return worst;
}

/// A branch along the axis of capsule(radius, 4), and one of that length across it from its middle.
BranchedCurve<double> with_twig(double length) {
    return straight_branches({{0, 0, 2}, {0, 0, -0.15}, {0, 0, 4.15}, {length, 0, 2}}, {{0, 1}, {2, 0}, {0, 3}}, 0.02);
}

} // namespace

TEST_CASE("a zigzag inside a tube comes to lie on its axis") {
    const Body<double> body = body_of(capsule(radius, 4));
    const CentredBranches<double> centred = centre_branches(zigzag(), body);
    REQUIRE(centred.branched.branches.size() == 1);
    const Points<double>& line = centred.branched.branches[0].line;
    REQUIRE(centred.sections.size() == 1);
    CHECK(centred.sections[0].size() == static_cast<std::size_t>(line.rows()));
    const double spacing = 0.01 * bounding_diagonal(body.mesh.vertices);
    CHECK(line.rows() - 1 == Approx(4.4 / spacing).epsilon(0.05));
    int along = 0;
    for (Eigen::Index i = 0; i < line.rows(); ++i) {
        INFO("point at " << line.row(i));
        const double off = line.row(i).head<2>().norm();
        CHECK(off < 0.5 * radius);
        if (line(i, 2) < 0.2 || line(i, 2) > 3.8) continue;
        CHECK(off < 0.02 * radius);
        CHECK(centred.sections[0][static_cast<std::size_t>(i)].encloses);
        ++along;
    }
    CHECK(along > 60);
    for (const Vec3& end : centred.branched.knots) {
        INFO("end at " << end.transpose());
        CHECK(distance_to_nearest(end, {{0, 0, -radius}, {0, 0, 4 + radius}}) < 0.2 * radius);
    }
}

namespace {

constexpr double tube = 0.25;

/// A ring around torus(1, tube) that swings to both sides of its circle, centred.
CentredBranches<double> centred_ring() {
    std::vector<Vec3> points;
    for (int i = 0; i <= 60; ++i) {
        const double angle = 2 * pi * (i % 60) / 60, away = 1 + (i % 2 == 0 ? 0.08 : -0.05);
        points.emplace_back(away * std::cos(angle), away * std::sin(angle), i % 3 == 0 ? 0.06 : -0.02);
    }
    const BranchedCurve<double> ring{{points[0]}, {{0, 0, make_mesh(points, {}).vertices, {0, 1}}}};
    const Body<double> body = body_of(torus(1, tube));
    return centre_branches(ring, body);
}

double off_circle(const Vec3& place) { return std::hypot(place.head<2>().norm() - 1, place[2]); }

} // namespace

TEST_CASE("the ring of a torus comes to lie on its circle") {
    const BranchedCurve<double> ring = centred_ring().branched;
    REQUIRE(ring.branches.size() == 1);
    CHECK(ring.branches[0].from == ring.branches[0].to);
    CHECK(cycles(join_branches(ring).curve) == 1);
    const Points<double>& line = ring.branches[0].line;
    CHECK(line.rows() > 60);
    for (Eigen::Index i = 1; i + 1 < line.rows(); ++i) {
        INFO("point " << i << " of " << line.rows() << " at " << line.row(i));
        CHECK(off_circle(point(line, i)) < 0.03 * tube);
    }
}

TEST_CASE("the node at which a ring begins is as well centred as the others") {
    const BranchedCurve<double> ring = centred_ring().branched;
    REQUIRE(ring.branches.size() == 1);
    const Points<double>& line = ring.branches[0].line;
    CHECK((point(line, 0) - ring.knots[0]).norm() < 1e-12);
    CHECK((point(line, line.rows() - 1) - ring.knots[0]).norm() < 1e-12);
    CHECK(off_circle(ring.knots[0]) < 0.03 * tube);
}

TEST_CASE("the branches of three tubes come to lie on their axes away from the junction", "[slow]") {
    const Body<double> body = body_of(three_tubes());
    REQUIRE(off_axes(bent_star(), 0.35, 0.9) > 0.2 * 0.12);
    const CentredBranches<double> centred = centre_branches(bent_star(), body);
    CHECK(knots_of_degree(centred.branched, 1).size() == 3);
    const std::vector<Vec3> junctions = knots_of_degree(centred.branched, 3);
    REQUIRE(junctions.size() == 1);
    INFO("junction at " << junctions[0].transpose());
    CHECK(junctions[0].norm() < 0.2 * 0.12);
    CHECK(off_axes(centred.branched, 0.35, 0.9) < 0.05 * 0.12);
    CHECK(centred.sections.size() == centred.branched.branches.size());
}

TEST_CASE("a turned body has the turned branches", "[slow]") {
    const Motion turn{random_rotation(11), 1, Vec3::Zero()};
    const Mesh mesh = three_tubes();
    BranchedCurve<double> star = bent_star();
    const Body<double> body = body_of(mesh), turned = body_of(moved(mesh, turn));
    const CentredBranches<double> expected = centre_branches(star, body);
    BranchCentringOptions options; // with the same distance between nodes: the bounding box is another one
    options.spacing *= bounding_diagonal(body.mesh.vertices) / bounding_diagonal(turned.mesh.vertices);
    for (Vec3& knot : star.knots) knot = turn.apply(knot);
    for (Branch<double>& branch : star.branches) branch.line = (branch.line * turn.rotation.transpose()).eval();
    const CentredBranches<double> found = centre_branches(star, turned, options);
    REQUIRE(found.branched.branches.size() == expected.branched.branches.size());
    for (std::size_t b = 0; b < found.branched.branches.size(); ++b) {
        const Points<double>& line = found.branched.branches[b].line;
        REQUIRE(line.rows() == expected.branched.branches[b].line.rows());
        CHECK((line - expected.branched.branches[b].line * turn.rotation.transpose()).cwiseAbs().maxCoeff() < 1e-9);
        CHECK(found.branched.branches[b].origins == expected.branched.branches[b].origins);
    }
}

TEST_CASE("a twig that hardly sticks out of the ball at its junction goes, and a long one stays") {
    const Body<double> body = body_of(capsule(radius, 4));
    const BranchedCurve<double> cut = prune_twigs(with_twig(1.4 * radius), body, 0.5);
    REQUIRE(cut.branches.size() == 1); // its junction goes, too
    CHECK(knots_of_degree(cut, 1).size() == 2);
    CHECK(total_length(cut) == Approx(4.3));
    CHECK(cut.branches[0].origins == std::vector<int>{0, 1, 2, 3, 4, 5, 6});
    const BranchedCurve<double> kept = prune_twigs(with_twig(1.6 * radius), body, 0.5);
    CHECK(kept.branches.size() == 3);
    CHECK(total_length(kept) == Approx(4.3 + 1.6 * radius));
    CHECK(prune_twigs(with_twig(1.6 * radius), body, 0.7).branches.size() == 1);
    CHECK(prune_twigs(with_twig(0.5 * radius), body, -1).branches.size() == 3);
}

TEST_CASE("a long twig goes where all of it but its tip is in the balls around the rest of the curve") {
    const Body<double> body = body_of(capsule(radius, 4));
    const auto along_axis = [&](double off_axis) { // and back to the surface at its end
        BranchedCurve<double> curve =
            straight_branches({{0, 0, 2}, {0, 0, -0.15}, {0, 0, 4.15}}, {{0, 1}, {2, 0}}, 0.02);
        curve.knots.push_back({radius, 0, 0.5});
        curve.branches.push_back(
            {0, 3, line_through({{0, 0, 2}, {off_axis, 0, 1.8}, {off_axis, 0, 0.6}, curve.knots[3]}, 0.02), {0, 3, 7}});
        return curve;
    };
    CHECK(prune_twigs(along_axis(0.5 * radius), body, 0.5).branches.size() == 1);
    CHECK(prune_twigs(along_axis(0.9 * radius), body, 0.5).branches.size() == 1);
    CHECK(prune_twigs(along_axis(1.5 * radius), body, 0.5).branches.size() == 3); // outside
    CHECK(prune_twigs(along_axis(0.5 * radius), body, -1).branches.size() == 3);
}

TEST_CASE("of several twigs the least goes first, and what is left of two at one junction may stay") {
    const Body<double> body = body_of(capsule(radius, 4));
    // The axis ends where two short branches leave it: without the shorter one, the other is the axis' end.
    BranchedCurve<double> fork =
        straight_branches({{0, 0, 3.9}, {0, 0, 0}, {0.1, 0, 4.0}, {-0.12, 0, 4.05}}, {{1, 0}, {0, 2}, {0, 3}}, 0.02);
    const BranchedCurve<double> cut = prune_twigs(fork, body, 0.5);
    REQUIRE(cut.branches.size() == 1);
    CHECK(distance_to_nearest(fork.knots[3], knots_of_degree(cut, 1)) == 0);
    // A curve without a junction has no twigs, nor have rings.
    CHECK(prune_twigs(zigzag(), body, 100).branches.size() == 1);
}

TEST_CASE("branch centring in float is that in double") {
    const Mesh mesh = capsule(radius, 4);
    const Body<float> body = body_of(TriangleMesh<float>{mesh.vertices.cast<float>(), mesh.faces});
    const BranchedCurve<double> start = zigzag();
    const BranchedCurve<float> rounded{{start.knots[0].cast<float>(), start.knots[1].cast<float>()},
                                       {{0, 1, start.branches[0].line.cast<float>(), {0, 1, 2}}}};
    const CentredBranches<float> found = centre_branches(rounded, body);
    const Body<double> same = body_of(mesh);
    const CentredBranches<double> expected = centre_branches(start, same);
    REQUIRE(found.branched.branches[0].line.rows() == expected.branched.branches[0].line.rows());
    CHECK((found.branched.branches[0].line.cast<double>() - expected.branched.branches[0].line).cwiseAbs().maxCoeff() <
          0.01 * radius);
}

TEST_CASE("laid roughly, branches come near the axes, and without rounds stay where they are") {
    const Body<double> body = body_of(capsule(radius, 4));
    const auto off_axis = [](const BranchedCurve<double>& branched) {
        const Points<double>& line = branched.branches.front().line;
        return line.leftCols(2).rowwise().norm().maxCoeff();
    };
    BranchCentringOptions options;
    CHECK(off_axis(centre_roughly(zigzag(), body, options)) < off_axis(zigzag()) / 4);
    options.rounds = 0;
    CHECK(off_axis(centre_roughly(zigzag(), body, options)) > off_axis(zigzag()) / 4);
    options.rounds = -1;
    CHECK(throws(ErrorCode::usage, [&] { static_cast<void>(centre_roughly(zigzag(), body, options)); }));
}

TEST_CASE("without rounds branches stay where they are but for their spacing") {
    const Body<double> body = body_of(capsule(radius, 4));
    BranchCentringOptions options;
    options.rounds = 0;
    const BranchedCurve<double> straight{{{0, 0, 0}, {0, 0, 4}},
                                         {{0, 1, line_through({{0, 0, 0}, {0, 0, 4}}, 1), {0, 1, 2}}}};
    const Points<double> line = centre_branches(straight, body, options).branched.branches[0].line;
    CHECK(line.leftCols<2>().cwiseAbs().maxCoeff() == 0);
    CHECK(line(0, 2) == 0);
    CHECK(line(line.rows() - 1, 2) == 4);
    CHECK(line.rows() > 50);
}

TEST_CASE("points outside the surface are moved into their sections") {
    const Body<double> body = body_of(capsule(radius, 4));
    BranchCentringOptions options;
    options.rounds = 0; // no spline that would move them first
    const BranchedCurve<double> bulging{
        {{0, 0, 0}, {0, 0, 4}},
        {{0, 1, line_through({{0, 0, 0}, {0, 0, 1}, {1.3 * radius, 0, 2}, {0, 0, 3}, {0, 0, 4}}, 0.05), {0, 1, 2}}}};
    const CentredBranches<double> found = centre_branches(bulging, body, options);
    const Points<double>& line = found.branched.branches[0].line;
    CHECK(line.leftCols<2>().rowwise().norm().maxCoeff() < radius);
    CHECK(line.leftCols<2>().rowwise().norm().maxCoeff() > 0.5 * radius); // no deeper than needed
    for (Eigen::Index i = 1; i + 1 < line.rows(); ++i) {
        INFO("point at " << line.row(i));
        CHECK(found.sections[0][static_cast<std::size_t>(i)].encloses);
    }
}

TEST_CASE("branch centring refuses options out of their ranges") {
    const Body<double> body = body_of(capsule(radius, 4));
    for (const BranchCentringOptions& options :
         {BranchCentringOptions{0, 9, 0.4, 0.5}, BranchCentringOptions{1.1, 9, 0.4, 0.5},
          BranchCentringOptions{0.01, -1, 0.4, 0.5}, BranchCentringOptions{0.01, 101, 0.4, 0.5},
          BranchCentringOptions{0.01, 9, -0.1, 0.5}, BranchCentringOptions{0.01, 9, 11, 0.5},
          BranchCentringOptions{0.01, 9, 0.4, -0.1}, BranchCentringOptions{0.01, 9, 0.4, 101},
          BranchCentringOptions{std::nan(""), 9, 0.4, 0.5}})
        CHECK(throws(ErrorCode::usage, [&] { static_cast<void>(centre_branches(zigzag(), body, options)); }));
    CHECK_NOTHROW(validate(BranchCentringOptions{}));
}
