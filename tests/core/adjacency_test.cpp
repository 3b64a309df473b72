#include <set>
#include <tuple>

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

TEST_CASE("directed edges are ordered by their vertices, then by their corners") {
    const Mesh mesh = torus(1, 0.3, 12, 8);
    const std::vector<DirectedEdge> edges = directed_edges(mesh.faces);
    REQUIRE(edges.size() == static_cast<std::size_t>(mesh.faces.size()));
    for (std::size_t i = 0; i < edges.size(); ++i) {
        const auto [low, high, corner, forward] = edges[i];
        const int from = mesh.faces.data()[corner], to = mesh.faces.data()[corner % 3 == 2 ? corner - 2 : corner + 1];
        CHECK((forward ? from : to) == low);
        CHECK((forward ? to : from) == high);
        CHECK(low < high);
        if (i > 0)
            CHECK(std::tuple(edges[i - 1].low, edges[i - 1].high, edges[i - 1].corner) < std::tuple(low, high, corner));
        CHECK(edges[i].joins_same(edges[i % 2 == 0 ? i + 1 : i - 1]));
    }
    CHECK(directed_edges(Triangles(0, 3)).empty());
}
