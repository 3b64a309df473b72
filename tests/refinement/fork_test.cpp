#include <algorithm>
#include <cmath>
#include <vector>

#include <skelgen/refinement/fork.hpp>

#include "catch.hpp"
#include "limb_shapes.hpp"
#include "shapes.hpp"

using namespace skelgen;
using namespace skelgen::refinement;
using namespace skelgen::core;
using namespace skelgen::test;

namespace {

EndPoint<double> end_near(const Mesh& mesh, const Vec3& place) { return end_point_near(body_of<double>(mesh), place); }

} // namespace

TEST_CASE("two tubes part where their inner sides meet, below their axes' meeting point") {
    const double radius = 0.12, step = 0.035;
    for (const double apart : {0.35, 0.6}) { // each foot from the middle, for legs of height 1
        const Vec3 top(0, 0, 1), left(apart, 0, 0), right(-apart, 0, 0);
        const Mesh mesh = tubes({{top, left}, {top, right}, {top, Vec3(0, 0, 2)}}, radius, step);
        const auto fork =
            fork_between(mesh, end_near(mesh, left - Vec3(0, 0, radius)), end_near(mesh, right - Vec3(0, 0, radius)));
        REQUIRE(fork.has_value());
        const double height = 1 - radius * std::hypot(1, apart) / apart;
        CHECK((*fork - Vec3(0, 0, height)).norm() < 1.5 * step);
    }
}

TEST_CASE("legs part highest on the way from foot to foot, even where one is longer") {
    const double radius = 0.12, step = 0.035, apart = 0.35;
    const Vec3 top(0, 0, 1), left(apart, 0, 0), right(-1.3 * apart, 0, -0.3);
    const Mesh mesh = tubes({{top, left}, {top, right}, {top, Vec3(0, 0, 2)}}, radius, step);
    const EndPoint<double> one = end_near(mesh, left - Vec3(0, 0, radius)),
                           two = end_near(mesh, right - Vec3(0, 0, radius));
    const Vec3 parted(0, 0, 1 - radius * std::hypot(1, apart) / apart);
    const auto equally_far = fork_between(mesh, one, two);
    REQUIRE(equally_far.has_value());
    CHECK((*equally_far - parted).norm() > 2 * step); // on the longer leg
    const std::vector<Crossing<double>> crossings = crossings_between(mesh, one, two, 0.6, 0.02);
    std::vector<std::size_t> levels(61, 0);
    for (const Crossing<double>& crossing : crossings) {
        REQUIRE(std::abs(crossing.level) <= 30);
        ++levels[static_cast<std::size_t>(crossing.level + 30)];
    }
    CHECK(std::count(levels.begin(), levels.end(), std::size_t(0)) == 0);
    CHECK((fork_along(crossings, Vec3(0.02, 0, 1.3), Vec3(0, 0, 1)) - parted).norm() < 1.5 * step);
}

TEST_CASE("legs part where it is lowest, as long as the way there is not the longer by more, on the highest level") {
    const Vec3 place(0, 0, 2), front(0, 0.3, 1), below(0, 0, 0.8), tail(0, -0.3, 0.5), thigh(0.2, 0, 0.7);
    const std::vector<Crossing<double>> level{{0, 1, front}, {0, 1.1, below}, {0, 1.6, tail}};
    CHECK(fork_along(level, place, Vec3(0, 0, 1)) == below);
    CHECK(fork_along({level[0], level[2]}, place, Vec3(0, 0, 1)) == front);
    CHECK(fork_along(level, place, Vec3(0, -1, 0)) == front); // seen by one who lies on the back
    std::vector<Crossing<double>> levels = level;
    levels.push_back({1, 0.5, thigh});
    levels.push_back({-1, 0.5, Vec3(-0.6, 0, 1)}); // raised, and as far off the axis
    CHECK(fork_along(levels, place, Vec3(0, 0, 1)) == below);
}

TEST_CASE("what is not joined has no fork") {
    Mesh mesh = tubes({{Vec3(0, 0, 0), Vec3(0, 0, 1)}}, 0.1, 0.05);
    const Mesh other = tubes({{Vec3(2, 0, 0), Vec3(2, 0, 1)}}, 0.1, 0.05);
    const Eigen::Index n = mesh.vertices.rows(), m = mesh.faces.rows();
    mesh.vertices.conservativeResize(n + other.vertices.rows(), 3);
    mesh.vertices.bottomRows(other.vertices.rows()) = other.vertices;
    mesh.faces.conservativeResize(m + other.faces.rows(), 3);
    mesh.faces.bottomRows(other.faces.rows()) = other.faces.array() + static_cast<int>(n);
    const EndPoint<double> one = end_near(mesh, Vec3(0, 0, 0)), two = end_near(mesh, Vec3(2, 0, 0));
    CHECK_FALSE(fork_between(mesh, one, two).has_value());
    CHECK(crossings_between(mesh, one, two, 0.5, 0.1).empty());
}

TEST_CASE("in float limbs part in the same place") {
    const Vec3 top(0, 0, 1), left(0.6, 0, 0), right(-0.6, 0, 0);
    const Mesh mesh = tubes({{top, left}, {top, right}, {top, Vec3(0, 0, 2)}}, 0.12, 0.05);
    const Body<float> body = body_of<float>(mesh);
    const auto exact = fork_between(mesh, end_near(mesh, left), end_near(mesh, right));
    const auto found = fork_between(body.mesh, end_point_near(body, left), end_point_near(body, right));
    REQUIRE(exact.has_value());
    REQUIRE(found.has_value());
    CHECK((found->cast<double>() - *exact).norm() < 1e-4);
}
