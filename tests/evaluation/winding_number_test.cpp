#include <skelgen/evaluation/winding_number.hpp>

#include "catch.hpp"

namespace {

using namespace skelgen;

/// The cube from 0 to 1, two triangles a side, faces looking outwards.
TriangleMesh<double> cube() {
    TriangleMesh<double> mesh;
    mesh.vertices.resize(8, 3);
    for (int i = 0; i < 8; ++i) mesh.vertices.row(i) << (i & 1), (i >> 1 & 1), (i >> 2 & 1);
    mesh.faces.resize(12, 3);
    mesh.faces << 0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3,
        7, 5;
    return mesh;
}

TEST_CASE("the surface goes once round what is inside and not at all round what is outside") {
    CHECK(winding_number(cube(), {0.5, 0.5, 0.5}) == Approx(1));
    CHECK(winding_number(cube(), {0.01, 0.9, 0.3}) == Approx(1));
    CHECK(winding_number(cube(), {1.01, 0.5, 0.5}) == Approx(0).margin(1e-12));
    CHECK(winding_number(cube(), {-30, 20, 10}) == Approx(0).margin(1e-12));
}

TEST_CASE("a cube without its lid covers five sixths of the view from its centre") {
    TriangleMesh<double> open = cube();
    open.faces = Triangles(open.faces.topRows(10));
    CHECK(winding_number(open, {0.5, 0.5, 0.5}) == Approx(5.0 / 6));
}

TEST_CASE("turning the faces over turns the sign") {
    TriangleMesh<double> inside_out = cube();
    inside_out.faces.col(0).swap(inside_out.faces.col(1));
    CHECK(winding_number(inside_out, {0.5, 0.5, 0.5}) == Approx(-1));
}

} // namespace
