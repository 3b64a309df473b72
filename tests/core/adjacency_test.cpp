#include <set>

#include <skelgen/core/adjacency.hpp>

#include "catch.hpp"
#include "mesh_changes.hpp"
#include "shapes.hpp"

using namespace skelgen;
using namespace skelgen::core;
using namespace skelgen::test;

TEST_CASE("adjacent faces see each other across the same edge") {
    const Mesh mesh = torus(1, 0.3, 12, 8);
    const Triangles adjacency = face_adjacency(mesh.faces);
    for (int f = 0; f < adjacency.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int g = adjacency(f, k);
            REQUIRE(g >= 0);
            int side = 0;
            while (side < 3 && adjacency(g, side) != f) ++side;
            REQUIRE(side < 3);
            CHECK(mesh.faces(g, side) == mesh.faces(f, (k + 1) % 3));
            CHECK(mesh.faces(g, (side + 1) % 3) == mesh.faces(f, k));
        }
}

TEST_CASE("there is nothing across a boundary") {
    const Mesh open = without_faces(sphere(1, 2), 3, 1);
    const Triangles adjacency = face_adjacency(open.faces);
    CHECK((adjacency.array() == -1).count() == 3);
}
