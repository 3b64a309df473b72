#include <cmath>

#include <skelgen/core/geometry.hpp>
#include <skelgen/curve/branch_sections.hpp>

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

/// A line along z from 0.5 to 3.5, `away` off the axis of capsule(radius, 4).
Points<double> line_beside(double away) {
    Points<double> line(31, 3);
    for (int i = 0; i <= 30; ++i) line.row(i) << away, 0, 0.5 + 0.1 * i + 0.013; // hardly any plane through vertices
    return line;
}

} // namespace

TEST_CASE("sections across a tube have their centres on its axis and its radius as thickness") {
    const Body<double> body = body_of(capsule(radius, 4, 64, 80));
    for (const double away : {0.0, 0.05}) {
        const Points<double> line = line_beside(away);
        const auto sections = sections_across(body, line, 0.0);
        REQUIRE(sections.size() == 31);
        for (std::size_t i = 1; i < 30; ++i) {
            const BranchSection<double>& section = sections[i];
            CHECK((section.centre - Vec3(0, 0, line(static_cast<Eigen::Index>(i), 2))).norm() < 1e-3 * radius);
            CHECK(section.thickness == Approx(radius).epsilon(0.005));
            CHECK(section.encloses);
            CHECK(section.contour.points.size() >= 64);
            if (away == 0) CHECK(section.weight > 0.9);
        }
        for (const std::size_t i : {std::size_t{0}, std::size_t{30}}) {
            CHECK(sections[i].weight == 0);
            CHECK(sections[i].thickness == 0);
            CHECK(sections[i].contour.points.empty());
        }
    }
}

TEST_CASE("a section is the less sure the farther off its centre and the nearer to the surface the line is") {
    const Body<double> body = body_of(capsule(radius, 4));
    double last = 1;
    for (const double away : {0.0, 0.06, 0.12, 0.18}) {
        const double weight = sections_across(body, line_beside(away), 0.0)[15].weight;
        CHECK(weight > 0);
        CHECK(weight <= last);
        last = weight;
    }
    CHECK(last < 0.2);
}

TEST_CASE("a line beside the surface has sections within reach that do not enclose it, and none beyond") {
    const Body<double> body = body_of(capsule(radius, 4));
    const Points<double> line = line_beside(radius + 0.05);
    const auto near = sections_across(body, line, 0.06), far = sections_across(body, line, 0.04);
    for (std::size_t i = 1; i < 30; ++i) {
        CHECK_FALSE(near[i].encloses);
        CHECK(near[i].thickness == Approx(radius).epsilon(0.02));
        CHECK(near[i].centre.head<2>().norm() < 0.01 * radius);
        CHECK(near[i].weight > 0);
        CHECK(near[i].weight < 0.8);
        CHECK(far[i].weight == 0);
        CHECK(far[i].thickness == 0);
        CHECK_FALSE(far[i].encloses);
        CHECK(far[i].contour.points.empty());
    }
}

TEST_CASE("sections are across the line, not across an axis") {
    const Body<double> body = body_of(capsule(radius, 4, 64, 80));
    Points<double> line(3, 3);
    const Vec3 slanted = Vec3(0, 0.3, 1).normalized();
    for (int i = 0; i < 3; ++i) line.row(i) = (Vec3(0, 0, 2) + 0.1 * (i - 1) * slanted).transpose();
    const auto sections = sections_across(body, line, 0.0);
    CHECK((sections[1].centre - Vec3(0, 0, 2)).norm() < 0.01 * radius);
    for (const Vec3& p : sections[1].contour.points) CHECK(slanted.dot(p - Vec3(0, 0, 2)) == Approx(0).margin(1e-12));
    CHECK(sections[1].thickness > radius); // an ellipse
    CHECK(sections[1].thickness < radius / slanted[2]);
}

TEST_CASE("a line of two points has no sections") {
    const Body<double> body = body_of(capsule(radius, 4));
    const auto sections = sections_across(body, Points<double>(line_beside(0).topRows(2)), 0.1);
    REQUIRE(sections.size() == 2);
    CHECK(sections[0].weight + sections[1].weight == 0);
}
