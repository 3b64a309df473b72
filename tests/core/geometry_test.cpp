#include <skelgen/core/geometry.hpp>

#include "catch.hpp"
#include "mesh_changes.hpp"
#include "shapes.hpp"

using namespace skelgen;
using namespace skelgen::core;
using namespace skelgen::test;

TEST_CASE("area and volume of shapes with closed forms") {
    CHECK(surface_area(box({1, 2, 3}, 2)) == Approx(22));
    CHECK(enclosed_volume(box({1, 2, 3}, 2)) == Approx(6));
    CHECK(surface_area(sphere(2, 5)) == Approx(16 * pi).epsilon(2e-3));
    CHECK(enclosed_volume(sphere(2, 5)) == Approx(32 * pi / 3).epsilon(3e-3));
    CHECK(surface_area(torus(2, 0.5, 128, 64)) == Approx(4 * pi * pi).epsilon(2e-3));
    CHECK(enclosed_volume(torus(2, 0.5, 128, 64)) == Approx(pi * pi).epsilon(3e-3));
    CHECK(enclosed_volume(capsule(0.5, 3, 96)) == Approx(pi * 0.25 * 3 + pi / 6).epsilon(3e-3));
    CHECK(enclosed_volume(cylinder(0.5, 3, 96)) == Approx(pi * 0.25 * 3).epsilon(2e-3));
}

TEST_CASE("turned over, a surface encloses a negative volume of the same size") {
    Mesh mesh = torus(1, 0.3);
    mesh.faces.col(0).swap(mesh.faces.col(1));
    CHECK(enclosed_volume(mesh) == Approx(-enclosed_volume(torus(1, 0.3))));
}

TEST_CASE("the area vectors of a closed surface add up to nothing") {
    Vec3 sum = Vec3::Zero();
    const Mesh mesh = three_tubes();
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) sum += face_area_vector(mesh, f);
    CHECK(sum.norm() == Approx(0).margin(1e-12));
}

TEST_CASE("the normals of a sphere point away from its centre") {
    const Mesh mesh = sphere(3, 4);
    const Points<double> normals = vertex_normals(mesh);
    for (Eigen::Index v = 0; v < normals.rows(); ++v)
        REQUIRE(normals.row(v).dot(mesh.vertices.row(v).normalized()) > 0.999);
}

TEST_CASE("a vertex that no face uses has no normal") {
    Mesh mesh = cube();
    mesh.vertices.conservativeResize(9, 3);
    mesh.vertices.row(8).setConstant(7);
    CHECK(vertex_normals(mesh).row(8).norm() == 0);
}

TEST_CASE("the winding number is 1 inside and 0 outside") {
    const Mesh ring = torus(1, 0.3);
    CHECK(winding_number(ring, Vec3(1, 0, 0.1)) == Approx(1));
    CHECK(winding_number(ring, Vec3(-0.8, 0.1, -0.1)) == Approx(1));
    CHECK(winding_number(ring, Vec3(0, 0, 0)) == Approx(0).margin(1e-12)); // in the hole
    CHECK(winding_number(ring, Vec3(1, 0, 0.4)) == Approx(0).margin(1e-12));
    CHECK(winding_number(ring, Vec3(50, 60, 70)) == Approx(0).margin(1e-12));
}

TEST_CASE("the winding number counts surfaces, with their sense, and sees through holes by the angle they take") {
    const Mesh two = side_by_side(sphere(1, 3), sphere(2, 3));
    CHECK(winding_number(two, Vec3(0.1, 0.2, 0.3)) == Approx(2));
    CHECK(winding_number(two, Vec3(1.5, 0, 0)) == Approx(1));
    Mesh inside_out = cube();
    inside_out.faces.col(0).swap(inside_out.faces.col(1));
    CHECK(winding_number(inside_out, Vec3(0.5, 0.4, 0.3)) == Approx(-1));
    const Mesh no_lid = without_faces(cube(), 10, 2);
    CHECK(winding_number(no_lid, Vec3(0.5, 0.5, 0.5)) == Approx(5.0 / 6));
}

TEMPLATE_TEST_CASE("the nearest of a segment is beside it or one of its ends", "[core]", float, double) {
    using Place = Vector3<TestType>;
    const Place a(1, 0, 0), b(5, 0, 0);
    const auto check = [](const NearestOnSegment<TestType>& nearest, double distance, double along) {
        CHECK(nearest.distance == Approx(distance));
        CHECK(nearest.along == Approx(along));
    };
    check(nearest_on_segment(Place(2, 3, 4), a, b), 5, 0.25);
    check(nearest_on_segment(Place(2, 3, 4), b, a), 5, 0.75);
    check(nearest_on_segment(Place(4, 0, 0), a, b), 0, 0.75);
    check(nearest_on_segment(Place(-2, 4, 0), a, b), 5, 0);
    check(nearest_on_segment(Place(8, 0, 4), a, b), 5, 1);
    check(nearest_on_segment(Place(4, 4, 0), a, a), 5, 0); // a segment that is a point
    using Pixel = Eigen::Matrix<TestType, 2, 1>;
    check(nearest_on_segment(Pixel(1, 1), Pixel(0, 0), Pixel(0, 4)), 1, 0.25);
}

TEST_CASE("a parabola is least at its vertex, no farther off than half a step", "[core]") {
    const auto least_of = [](auto&& f) { return least_of_parabola<double>(f(-1), f(0), f(1)); };
    for (const double vertex : {-0.5, -0.2, 0.0, 0.4})
        CHECK(least_of([&](double x) { return 3 + 2 * (x - vertex) * (x - vertex); }) == Approx(vertex).margin(1e-12));
    CHECK(least_of([](double x) { return (x - 7) * (x - 7); }) == 0.5);
    CHECK(least_of([](double x) { return (x + 7) * (x + 7); }) == -0.5);
    CHECK(least_of([](double x) { return -x * x; }) == 0);
    CHECK(least_of([](double) { return 4.0; }) == 0);
}
