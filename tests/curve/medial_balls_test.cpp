#include <algorithm>
#include <cmath>

#include <skelgen/curve/medial_balls.hpp>

#include "catch.hpp"
#include "mesh_changes.hpp"
#include "shapes.hpp"

using namespace skelgen;
using namespace skelgen::test;

TEST_CASE("every ball of a sphere is the sphere") {
    const MedialBalls balls = medial_balls(sphere(2, 4), 10);
    CHECK(balls.centres.rowwise().norm().maxCoeff() < 0.1 * 2);
    CHECK(balls.radii.minCoeff() > 0.9 * 2);
    CHECK(balls.radii.maxCoeff() < 1.1 * 2);
}

TEST_CASE("the balls of a tube have its radius and lie on its axis") {
    const Mesh mesh = capsule(0.3, 4, 32, 60);
    const MedialBalls balls = medial_balls(mesh, 10);
    for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
        if (mesh.vertices(v, 2) < 0.3 || mesh.vertices(v, 2) > 3.7) continue;
        INFO("vertex at " << mesh.vertices.row(v));
        REQUIRE(balls.centres.row(v).head<2>().norm() < 0.1 * 0.3);
        REQUIRE(balls.centres(v, 2) == Approx(mesh.vertices(v, 2)).margin(0.05));
        REQUIRE(balls.radii[v] == Approx(0.3).epsilon(0.1));
    }
}

TEST_CASE("the balls of a torus lie on its circle") {
    const MedialBalls balls = medial_balls(torus(1, 0.25, 80, 28), 10);
    for (Eigen::Index v = 0; v < balls.centres.rows(); ++v) {
        const double from_axis = balls.centres.row(v).head<2>().norm();
        REQUIRE(std::hypot(from_axis - 1, balls.centres(v, 2)) < 0.12 * 0.25);
    }
}

TEST_CASE("no ball is larger than asked for and each touches its vertex") {
    const Mesh mesh = three_tubes();
    const MedialBalls balls = medial_balls(mesh, 0.07);
    CHECK(balls.radii.maxCoeff() <= 0.07);
    CHECK(balls.radii.minCoeff() > 0);
    for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v)
        REQUIRE((balls.centres.row(v) - mesh.vertices.row(v)).norm() == Approx(balls.radii[v]));
}
