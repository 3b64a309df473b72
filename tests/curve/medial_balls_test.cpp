#include <algorithm>
#include <cmath>

#include <skelgen/core/geometry.hpp>
#include <skelgen/curve/medial_balls.hpp>

#include "catch.hpp"
#include "curve/proxy_mesh.hpp"
#include "mesh_changes.hpp"
#include "shapes.hpp"

using namespace skelgen;
using namespace skelgen::curve;
using namespace skelgen::test;

TEMPLATE_TEST_CASE("every ball of a sphere is the sphere", "", float, double) {
    const MedialBalls<TestType> balls = medial_balls(mesh_in<TestType>(sphere(2, 4)), 10);
    CHECK(balls.centres.rowwise().norm().maxCoeff() < 0.1 * 2);
    CHECK(balls.radii.minCoeff() > 0.9 * 2);
    CHECK(balls.radii.maxCoeff() < 1.1 * 2);
}

TEST_CASE("the balls of a tube have its radius and lie on its axis") {
    const Mesh mesh = capsule(0.3, 4, 32, 60);
    const MedialBalls<double> balls = medial_balls(mesh, 10);
    for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
        if (mesh.vertices(v, 2) < 0.3 || mesh.vertices(v, 2) > 3.7) continue;
        INFO("vertex at " << mesh.vertices.row(v));
        REQUIRE(balls.centres.row(v).head<2>().norm() < 0.1 * 0.3);
        REQUIRE(balls.centres(v, 2) == Approx(mesh.vertices(v, 2)).margin(0.05));
        REQUIRE(balls.radii[v] == Approx(0.3).epsilon(0.1));
    }
}

TEMPLATE_TEST_CASE("the balls of a torus lie on its circle", "", float, double) {
    const MedialBalls<TestType> balls = medial_balls(mesh_in<TestType>(torus(1, 0.25, 80, 28)), 10);
    for (Eigen::Index v = 0; v < balls.centres.rows(); ++v) {
        const TestType from_axis = balls.centres.row(v).template head<2>().norm();
        REQUIRE(std::hypot(from_axis - 1, balls.centres(v, 2)) < 0.12 * 0.25);
    }
}

namespace {

/// The ball at a vertex as MBC12 has it, by looking at all vertices.
double shrunk_radius(const Mesh& mesh, const Points<double>& normals, Eigen::Index v, double radius) {
    const Vec3 p = core::point(mesh.vertices, v), n = core::point(normals, v);
    for (int step = 0; step < 30; ++step) {
        const int nearest = core::nearest_point<double>(mesh.vertices, p - radius * n);
        const Vec3 chord = p - core::point(mesh.vertices, nearest);
        const double distance = (chord - radius * n).norm(), along = chord.dot(n);
        if (nearest == v || distance >= radius * (1 - 1e-12) || along <= 0) break;
        const double shrunk = chord.squaredNorm() / (2 * along);
        if (1 - chord.squaredNorm() / (2 * shrunk * shrunk) > 0.8) break;
        radius = shrunk;
    }
    return radius;
}

} // namespace

TEST_CASE("the balls are those that all vertices leave room for, in any unit") {
    for (const double unit : {1.0, 1e-20, 1e15}) {
        Mesh mesh = shuffled(three_tubes(), 3);
        mesh.vertices *= unit;
        const Points<double> normals = core::vertex_normals(mesh);
        const MedialBalls<double> balls = medial_balls(mesh, unit);
        for (Eigen::Index v = 0; v < mesh.vertices.rows(); v += 7)
            REQUIRE(balls.radii[v] == Approx(shrunk_radius(mesh, normals, v, unit)));
    }
}

TEST_CASE("no ball is larger than asked for and each touches its vertex") {
    const Mesh mesh = three_tubes();
    const MedialBalls<double> balls = medial_balls(mesh, 0.07);
    CHECK(balls.radii.maxCoeff() <= 0.07);
    CHECK(balls.radii.minCoeff() > 0);
    for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v)
        REQUIRE((balls.centres.row(v) - mesh.vertices.row(v)).norm() == Approx(balls.radii[v]));
}
