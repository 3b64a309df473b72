#include <skelgen/surface/impl/triangulate_rim.hpp>

#include <array>
#include <cmath>
#include <vector>

#include <skelgen/core/error.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/surface/impl/fill_holes.hpp>
#include <skelgen/surface/pieces.hpp>

#include "catch.hpp"
#include "mesh_changes.hpp"
#include "shapes.hpp"

using namespace skelgen;
using namespace skelgen::surface;
using namespace skelgen::test;

namespace {

/// The square from 0 to 1 in the plane z = 0 is left out of it, with a face at each of its edges.
struct SquareHole {
    Mesh mesh =
        make_mesh({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, -1, 0}, {2, 0.5, 0}, {0.5, 2, 0}, {-1, 0.5, 0}},
                  {{1, 0, 4}, {2, 1, 5}, {3, 2, 6}, {0, 3, 7}});
    Rim rim{{0, 1, 2, 3}, {0, 1, 2, 3}};
};

bool nothing_there(int, int) { return false; }

/// The side of a polygonal cylinder, without those of its faces that lie in front, in the middle of its length.
Mesh tube_open_in_front(int around, double length) {
    constexpr int rows = 9;
    std::vector<Vec3> vertices;
    std::vector<std::array<int, 3>> faces;
    for (int row = 0; row <= rows; ++row)
        for (int i = 0; i < around; ++i) {
            const double angle = 2 * pi * i / around;
            vertices.emplace_back(std::cos(angle), std::sin(angle), length * row / rows);
        }
    for (int row = 0; row < rows; ++row)
        for (int i = 0; i < around; ++i) {
            if (row >= 2 && row < 7 && i < around / 2) continue;
            const int a = row * around + i, b = row * around + (i + 1) % around;
            faces.push_back({a, b, b + around});
            faces.push_back({a, b + around, a + around});
        }
    return used_part(make_mesh(vertices, faces)).mesh;
}

} // namespace

TEMPLATE_TEST_CASE("a flat hole is closed by flat triangles that look where the surface does", "[surface]", float,
                   double) {
    const SquareHole hole;
    const TriangleMesh<TestType> mesh{hole.mesh.vertices.template cast<TestType>(), hole.mesh.faces};
    const auto triangles = triangulate_rim(mesh, hole.rim, nothing_there);
    REQUIRE(triangles);
    REQUIRE(triangles->size() == 2);
    for (const auto& t : *triangles) {
        const auto corner = [&](std::size_t k) { return core::point(mesh.vertices, t[k]); };
        const Vector3<TestType> doubled = (corner(1) - corner(0)).cross(corner(2) - corner(0));
        CHECK(doubled.dot(Vector3<TestType>::UnitZ()) == 1);
        CHECK(doubled.norm() == 1);
    }
}

TEST_CASE("no triangle takes an edge that is there already", "[surface]") {
    const SquareHole hole;
    const auto other = triangulate_rim(hole.mesh, hole.rim, [](int i, int j) { return i == 0 && j == 2; });
    REQUIRE(other);
    for (const auto& t : *other) CHECK((t == std::array{0, 1, 3} || t == std::array{1, 2, 3}));
    CHECK_FALSE(triangulate_rim(hole.mesh, hole.rim, [](int, int) { return true; }));
}

TEST_CASE("a rim of two edges, or all on one line, cannot be closed", "[surface]") {
    SquareHole hole;
    CHECK_FALSE(triangulate_rim(hole.mesh, Rim{{0, 1}, {0, 1}}, nothing_there));
    CHECK_THROWS_AS(triangulate_rim(hole.mesh, Rim{{0, 1, 2}, {0}}, nothing_there), Error);
    hole.mesh.vertices.topRows(4).col(1).setZero();
    CHECK_FALSE(triangulate_rim(hole.mesh, hole.rim, nothing_there));
}

TEST_CASE("a tube open in front is closed as round as it was", "[surface]") {
    constexpr int around = 16;
    constexpr double length = 6;
    const FilledSurface<double> closed = fill_holes(tube_open_in_front(around, length), 1);
    CHECK(closed.filled == 3); // its ends, too
    CHECK(closed.open == 0);
    const double section = around / 2.0 * std::sin(2 * pi / around);
    CHECK(core::enclosed_volume(closed.mesh) == Approx(section * length).epsilon(1e-12));
}

TEST_CASE("a hole with more edges than can be tried is closed by a fan", "[surface]") {
    constexpr int around = 600;
    const Mesh open = tube_open_in_front(around, 6);
    const FilledSurface<double> closed = fill_holes(open, 1);
    CHECK(closed.filled == 3);
    CHECK(is_closed(closed.mesh.faces));
    CHECK(closed.mesh.vertices.rows() == open.vertices.rows() + 3); // the middles
}
