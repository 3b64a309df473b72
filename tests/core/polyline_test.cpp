#include <cmath>

#include <skelgen/core/polyline.hpp>

#include "catch.hpp"
#include "shapes.hpp"

using namespace skelgen;
using namespace skelgen::core;
using namespace skelgen::test;

namespace {

/// Right by 3, up by 4, back by 5 in steps of different lengths.
Points<double> corner_line() {
    Points<double> line(5, 3);
    line << 0, 0, 0, 1, 0, 0, 3, 0, 0, 3, 4, 0, 3, 4, -5;
    return line;
}

} // namespace

TEST_CASE("arc lengths add up the steps") {
    const Eigen::VectorXd arc = arc_lengths(corner_line());
    const Eigen::VectorXd expected = (Eigen::VectorXd(5) << 0, 1, 3, 7, 12).finished();
    CHECK(arc.isApprox(expected));
}

TEST_CASE("a point at an arc length lies on the line and is held at its ends") {
    const Points<double> line = corner_line();
    const Eigen::VectorXd arc = arc_lengths(line);
    const auto is_at = [&](double s, const Vec3& expected) {
        return (point_at(line, arc, s) - expected).norm() < 1e-12;
    };
    CHECK(is_at(0.5, {0.5, 0, 0}));
    CHECK(is_at(3, {3, 0, 0}));
    CHECK(is_at(5, {3, 2, 0}));
    CHECK(is_at(11, {3, 4, -4}));
    CHECK(is_at(-2, {0, 0, 0}));
    CHECK(is_at(100, {3, 4, -5}));
    const Eigen::VectorXd values = (Eigen::VectorXd(5) << 1, 3, 7, 7, -3).finished();
    CHECK(value_at(values, arc, 0.5) == Approx(2));
    CHECK(value_at(values, arc, 11.0) == Approx(-1));
    CHECK(value_at(values, arc, -4.0) == 1);
    CHECK(value_at(values, arc, 40.0) == -3);
}

TEST_CASE("a line of one point is that point everywhere") {
    const Points<double> line = Points<double>::Constant(1, 3, 2.5);
    CHECK(point_at(line, arc_lengths(line), 7.0) == Vec3(2.5, 2.5, 2.5));
}

TEST_CASE("points that coincide do no harm") {
    Points<double> line(3, 3);
    line << 0, 0, 0, 0, 0, 0, 2, 0, 0;
    CHECK((point_at(line, arc_lengths(line), 0.0) - Vec3::Zero()).norm() == 0);
    CHECK((point_at(line, arc_lengths(line), 1.0) - Vec3(1, 0, 0)).norm() < 1e-15);
}

TEST_CASE("resampling keeps the ends and spaces the points evenly") {
    Points<double> circle(200, 3);
    for (Eigen::Index i = 0; i < 200; ++i) {
        const double angle = 1.5 * pi * std::pow(static_cast<double>(i) / 199, 2);
        circle.row(i) << std::cos(angle), std::sin(angle), 0;
    }
    const Points<double> even = resample(circle, 0.1);
    CHECK(even.row(0) == circle.row(0));
    CHECK(even.row(even.rows() - 1).isApprox(circle.row(199)));
    CHECK(even.rows() == 48); // 1.5 pi / 0.1 = 47.1 pieces
    for (Eigen::Index i = 1; i < even.rows(); ++i)
        REQUIRE((even.row(i) - even.row(i - 1)).norm() == Approx(1.5 * pi / 47).epsilon(5e-3));
}

TEST_CASE("a step longer than the line leaves its two ends") {
    const Points<double> ends = resample(corner_line(), 1000.0);
    REQUIRE(ends.rows() == 2);
    CHECK(ends.row(0) == corner_line().row(0));
    CHECK(ends.row(1).isApprox(corner_line().row(4)));
}

TEST_CASE("the tangent of a circle is normal to its radius, with unit length") {
    Points<double> circle(60, 3);
    for (Eigen::Index i = 0; i < 60; ++i) {
        const double angle = 0.1 * static_cast<double>(i);
        circle.row(i) << std::cos(angle), std::sin(angle), 1;
    }
    for (const Eigen::Index i : {5, 20, 50}) {
        const Vec3 tangent = tangent_at(circle, i, 3);
        CHECK(tangent.norm() == Approx(1));
        CHECK((tangent - Vec3(-circle(i, 1), circle(i, 0), 0)).norm() < 1e-9);
    }
}
