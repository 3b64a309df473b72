#include <skelgen/evaluation/curve_error.hpp>

#include <cmath>
#include <vector>

#include <skelgen/core/error.hpp>
#include <skelgen/core/geometry.hpp>

#include "catch.hpp"

namespace {

using namespace skelgen;
using namespace skelgen::evaluation;
using Vec3 = Vector3<double>;

/// Nodes a unit apart from one place to another, as many as fit, joined to a node that may be there already.
void add_line(CurveSkeleton<double>& curve, const Vec3& from, const Vec3& to, double radius) {
    const auto node_at = [&](const Vec3& place) {
        for (Eigen::Index i = 0; i < curve.nodes.rows(); ++i)
            if ((core::point(curve.nodes, i) - place).norm() < 1e-9) return static_cast<int>(i);
        curve.nodes.conservativeResize(curve.nodes.rows() + 1, 3);
        core::set_point(curve.nodes, curve.nodes.rows() - 1, place);
        curve.radii.push_back(radius);
        return static_cast<int>(curve.nodes.rows()) - 1;
    };
    const int pieces = static_cast<int>(std::lround((to - from).norm()));
    for (int i = 0; i < pieces; ++i) {
        const int a = node_at(from + (to - from) * i / pieces), b = node_at(from + (to - from) * (i + 1) / pieces);
        curve.edges.push_back({std::min(a, b), std::max(a, b)});
    }
}

CurveSkeleton<double> line(const Vec3& from, const Vec3& to, double radius) {
    CurveSkeleton<double> curve;
    add_line(curve, from, to, radius);
    return curve;
}

/// 20 long, as thick as it is told to be.
CurveSkeleton<double> straight(double radius = 2) { return line({0, 0, 0}, {20, 0, 0}, radius); }

/// A bar 40 long and in its middle a branch 15 long.
CurveSkeleton<double> branching(double bar_radius = 2, double branch_radius = 2) {
    CurveSkeleton<double> curve = line({-20, 0, 0}, {20, 0, 0}, bar_radius);
    add_line(curve, {0, 0, 0}, {0, 0, 15}, branch_radius);
    return curve;
}

CurveSkeleton<double> moved(CurveSkeleton<double> curve, const Vec3& offset) {
    curve.nodes.rowwise() += offset.transpose();
    return curve;
}

TEST_CASE("a curve that is the axis has no error") {
    for (const auto& curve : {straight(), branching()}) {
        const CurveError error = measure_curve(curve, curve);
        CHECK(error.hausdorff == 0);
        CHECK(error.mean == 0);
        CHECK(error.radius_error == 0);
        CHECK(error.end_error == 0);
        CHECK(error.ends == error.true_ends);
        CHECK(error.cycles == 0);
        CHECK(error.true_cycles == 0);
    }
}

TEST_CASE("a curve beside the axis is as far from it as it is beside it, in radii") {
    const CurveError error = measure_curve(moved(straight(), {0, 0.5, 0}), straight());
    CHECK(error.hausdorff == Approx(0.25));
    CHECK(error.mean == Approx(0.25));
    CHECK(error.end_error == Approx(0.25));
    CHECK(error.ends == 2);
    CHECK(error.true_ends == 2);
}

TEST_CASE("coarse curves and axes are compared between their nodes too") {
    CurveSkeleton<double> bow; // a node at either end and one above the middle
    add_line(bow, {0, 0, 0}, {1, 0, 0}, 2);
    bow.nodes.resize(3, 3);
    bow.nodes << 0, 0, 0, 10, 1, 0, 20, 0, 0;
    bow.edges = {{0, 1}, {1, 2}};
    bow.radii = {2, 2, 2};
    CHECK(measure_curve(bow, straight()).hausdorff == Approx(0.5));
    // From the middle of the axis it is sqrt(100 / 101) to either half of the bow.
    CHECK(measure_curve(straight(), bow).hausdorff == Approx(0.5));
}

TEST_CASE("what a curve lacks or has too much near its ends is no distance, but an error of the ends") {
    const CurveError shorter = measure_curve(line({1, 0, 0}, {19, 0, 0}, 2), straight());
    CHECK(shorter.hausdorff == 0);
    CHECK(shorter.end_error == Approx(0.5));
    const CurveError longer = measure_curve(line({-2, 0, 0}, {22, 0, 0}, 2), straight());
    CHECK(longer.hausdorff == 0);
    CHECK(longer.end_error == Approx(1));
}

TEST_CASE("a branch that is not there counts with its length, but for the end") {
    const CurveError error = measure_curve(line({-20, 0, 0}, {20, 0, 0}, 2), branching());
    CHECK(error.ends == 2);
    CHECK(error.true_ends == 3);
    CHECK(error.hausdorff == Approx((15 - 1.5 * 2) / 2).margin(0.15)); // of samples an eighth of a radius apart
    CHECK(error.end_error == Approx(std::hypot(20, 15) / 2));
}

TEST_CASE("a branch too many counts as well") {
    const CurveError error = measure_curve(branching(), line({-20, 0, 0}, {20, 0, 0}, 2));
    CHECK(error.ends == 3);
    CHECK(error.true_ends == 2);
    CHECK(error.hausdorff == Approx((15 - 1.5 * 2) / 2).margin(0.15));
    CHECK(error.end_error == 0);
}

TEST_CASE("cycles are counted, and those too many are away from the axis") {
    CurveSkeleton<double> curve = straight();
    add_line(curve, {7, 0, 0}, {7, 4, 0}, 2);
    add_line(curve, {7, 4, 0}, {13, 4, 0}, 2);
    add_line(curve, {13, 4, 0}, {13, 0, 0}, 2);
    const CurveError error = measure_curve(curve, straight());
    CHECK(error.ends == 2);
    CHECK(error.cycles == 1);
    CHECK(error.true_cycles == 0);
    CHECK(error.hausdorff == Approx(2));
    CHECK(measure_curve(straight(), curve).true_cycles == 1);
}

TEST_CASE("cycles of curves in several pieces are those of the pieces") {
    CurveSkeleton<double> curve = straight();
    add_line(curve, {0, 2, 0}, {20, 2, 0}, 2);
    const CurveError error = measure_curve(curve, straight());
    CHECK(error.cycles == 0);
    CHECK(error.ends == 4);
}

TEST_CASE("near a junction, distances are in the radius of the thickest tube there") {
    const CurveSkeleton<double> truth = branching(4, 1); // 1.5 * 4 along the thin branch
    CurveSkeleton<double> curve = line({-20, 0, 0}, {20, 0, 0}, 4);
    add_line(curve, {0, 0, 0}, {0, 0, 5}, 1);
    add_line(curve, {0, 0, 5}, {0, 1, 5}, 1);
    add_line(curve, {0, 1, 5}, {0, 0, 5}, 1); // there and back: a node beside the branch
    add_line(curve, {0, 0, 5}, {0, 0, 15}, 1);
    CHECK(measure_curve(curve, truth).hausdorff == Approx(0.25));
    CHECK(measure_curve(moved(curve, {0, 0, 4}), truth).hausdorff > 0.9);
}

TEST_CASE("radii are compared away from ends and junctions") {
    CurveSkeleton<double> curve = branching();
    for (double& radius : curve.radii) radius = 2.2;
    CHECK(measure_curve(curve, branching()).radius_error == Approx(0.1));
    for (std::size_t i = 0; i < curve.radii.size(); ++i) {
        const Vec3 place = core::point(curve.nodes, static_cast<Eigen::Index>(i));
        const bool counts = place.norm() > 5 && std::abs(place.x()) < 15 && place.z() < 10;
        curve.radii[i] = counts ? 2 : 7;
    }
    CHECK(measure_curve(curve, branching()).radius_error == 0);
}

TEST_CASE("no curve is infinitely far away, one of a single node is not") {
    const CurveError none = measure_curve({}, straight());
    CHECK(std::isinf(none.hausdorff));
    CHECK(std::isinf(none.end_error));
    CHECK(none.ends == 0);
    CHECK(none.cycles == 0);
    CurveSkeleton<double> node;
    node.nodes.resize(1, 3);
    node.nodes << 10, 0, 0;
    node.radii = {2};
    CHECK(measure_curve(node, straight()).hausdorff == Approx((10 - 1.5 * 2) / 2).margin(0.15));
}

TEST_CASE("an axis without edges or without radii is refused") {
    CHECK_THROWS_AS(measure_curve(straight(), {}), Error);
    CurveSkeleton<double> bare = straight();
    bare.radii.pop_back();
    CHECK_THROWS_AS(measure_curve(straight(), bare), Error);
    bare.radii.clear();
    CHECK_THROWS_AS(measure_curve(straight(), bare), Error);
}

} // namespace
