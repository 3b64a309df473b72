#include <cmath>
#include <limits>

#include <skelgen/core/adjacency.hpp>
#include <skelgen/refinement/centreline.hpp>

#include "catch.hpp"
#include "limb_shapes.hpp"
#include "shapes.hpp"

using namespace skelgen;
using namespace skelgen::refinement;
using namespace skelgen::core;
using namespace skelgen::test;

namespace {

template <typename Scalar>
Centreline<Scalar> centreline_of(const TriangleMesh<Scalar>& mesh, const Points<Scalar>& line,
                                 const CentrelineOptions& options) {
    const Triangles adjacency = face_adjacency(mesh.faces);
    return draw_centreline(Slicer<Scalar>(mesh, adjacency), line, options);
}

template <typename Scalar>
void check_is_consistent(const Centreline<Scalar>& line) {
    const Eigen::Index n = line.points.rows();
    CHECK(line.arc.size() == n);
    CHECK(line.thickness.size() == n);
    CHECK(line.area.size() == n);
    CHECK(line.flatness.size() == n);
    CHECK(line.arc[0] == 0);
    for (Eigen::Index i = 1; i < n; ++i)
        CHECK(line.arc[i] - line.arc[i - 1] == Approx((line.points.row(i) - line.points.row(i - 1)).norm()));
}

} // namespace

TEMPLATE_TEST_CASE("the centreline of a straight tube is its axis, wherever it is begun", "", float, double) {
    constexpr double radius = 0.2;
    Points<TestType> off_axis(2, 3);
    off_axis << TestType(0.1), TestType(0.05), TestType(0.4), TestType(0.1), TestType(0.05), TestType(3.6);
    const auto line = centreline_of<TestType>(mesh_in<TestType>(capsule(radius, 4)), off_axis, {0.05, 3, 1.0});
    check_is_consistent(line);
    const TestType tolerance = 16 * std::numeric_limits<TestType>::epsilon();
    CHECK((line.points.row(0) - off_axis.row(0)).norm() < tolerance); // ends stay
    CHECK((line.points.template bottomRows<1>() - off_axis.row(1)).norm() < tolerance);
    for (Eigen::Index i = 5; i + 5 < line.points.rows(); ++i) {
        INFO("at arc length " << line.arc[i]);
        CHECK(line.points.row(i).template head<2>().norm() < 0.02 * radius);
        CHECK(line.thickness[i] == Approx(radius).epsilon(0.02));
        CHECK(line.area[i] == Approx(pi * radius * radius).epsilon(0.02));
        CHECK(line.flatness[i] < 0.01);
    }
}

TEST_CASE("the centreline of a bent tube bends with it") {
    constexpr double small = 0.15; // a torus of radius 1: begun outside of its circle, and nearer its hole at the end
    Points<double> rough(24, 3);
    for (Eigen::Index i = 0; i < 24; ++i) {
        const double angle = 0.1 * static_cast<double>(i), distance = 1.06 - 0.005 * static_cast<double>(i);
        rough.row(i) << distance * std::cos(angle), distance * std::sin(angle), 0.03;
    }
    const auto line = centreline_of(torus(1, small, 120, 32), rough, {0.04, 3, 1.0});
    check_is_consistent(line);
    for (Eigen::Index i = 5; i + 5 < line.points.rows(); ++i) {
        INFO("at arc length " << line.arc[i]);
        CHECK(line.points.row(i).head<2>().norm() == Approx(1).margin(0.05 * small));
        CHECK(line.points(i, 2) == Approx(0).margin(0.05 * small));
        CHECK(line.thickness[i] == Approx(small).epsilon(0.03));
        CHECK(line.area[i] == Approx(pi * small * small).epsilon(0.04));
    }
}

TEST_CASE("where there is no section there is no thickness, and the line goes on") {
    Points<double> through(2, 3);
    through << 0, 0, -3, 0, 0, 7; // a capsule from -0.2 to 4.2
    const auto line = centreline_of(capsule(0.2, 4), through, {0.1, 2, 1.0});
    check_is_consistent(line);
    CHECK(line.points.allFinite());
    for (Eigen::Index i = 0; i < line.points.rows(); ++i) {
        const double z = line.points(i, 2);
        INFO("at z = " << z);
        if (z < -0.7 || z > 4.7) CHECK(line.thickness[i] == 0);
        if (z > 0.3 && z < 3.7) CHECK(line.thickness[i] > 0.19);
    }
}

TEST_CASE("options of a centreline that would take for ever are refused") {
    CHECK_NOTHROW(validate(CentrelineOptions{}));
    CHECK_THROWS_AS(validate(CentrelineOptions{0, 2, 1}), Error);
    CHECK_THROWS_AS(validate(CentrelineOptions{-0.01, 2, 1}), Error);
    CHECK_THROWS_AS(validate(CentrelineOptions{0.01, 1000, 1}), Error);
    CHECK_THROWS_AS(validate(CentrelineOptions{std::nan(""), 2, 1}), Error);
}
