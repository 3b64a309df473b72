#include <algorithm>
#include <cmath>
#include <set>

#include <skelgen/core/adjacency.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/surface/impl/cut_surface.hpp>
#include <skelgen/surface/impl/handle_loops.hpp>
#include <skelgen/surface/open_handles.hpp>
#include <skelgen/surface/prepare.hpp>

#include "catch.hpp"
#include "mesh_changes.hpp"
#include "shapes.hpp"

using namespace skelgen;
using namespace skelgen::core;
using namespace skelgen::surface;
using namespace skelgen::test;

namespace {

/// 1 minus half the Euler characteristic of a closed connected mesh.
Eigen::Index genus(const Mesh& mesh) { return 1 - (mesh.vertices.rows() - mesh.faces.rows() / 2) / 2; }

bool is_edge(const Mesh& mesh, int a, int b) {
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f)
        for (int k = 0; k < 3; ++k)
            if (mesh.faces(f, k) == a && mesh.faces(f, (k + 1) % 3) == b) return true;
    return false;
}

} // namespace

TEST_CASE("a sphere has no handle, and no crease") {
    const Mesh ball = sphere(1);
    const Triangles adjacency = face_adjacency(ball.faces);
    const CreaseGraph<double> creases = crease_graph(ball, adjacency);
    CHECK(handle_loops(creases, 0).empty());
    CHECK(handle_loops(creases, 0, 1.0).empty());
    for (const double factor : creases.factors) CHECK(factor == 1);
}

TEST_CASE("a torus has two loops, closed ones along its edges, and the shorter one goes around the tube") {
    const Mesh ring = torus(1, 0.2);
    const CreaseGraph<double> creases = crease_graph(ring, face_adjacency(ring.faces));
    for (const int root : {0, 17, static_cast<int>(ring.vertices.rows()) - 1}) {
        const std::vector<HandleLoop<double>> loops = handle_loops(creases, root);
        REQUIRE(loops.size() == 2);
        CHECK(loops[0].length < 1.1 * 2 * pi * 0.2);
        CHECK(loops[0].length > 0.8 * 2 * pi * 0.2);
        CHECK(loops[1].length >= loops[0].length);
        CHECK(loops[1].length < 1.1 * 2 * pi * 1.2);
        for (const HandleLoop<double>& loop : loops) {
            CHECK(std::set<int>(loop.vertices.begin(), loop.vertices.end()).size() == loop.vertices.size());
            for (std::size_t i = 0; i < loop.vertices.size(); ++i)
                CHECK(is_edge(ring, loop.vertices[i], loop.vertices[(i + 1) % loop.vertices.size()]));
        }
    }
}

TEST_CASE("of loops no longer than a limit those that are shorter are found alike") {
    const Mesh ring = torus(1, 0.2);
    const CreaseGraph<double> creases = crease_graph(ring, face_adjacency(ring.faces));
    for (int root = 0; root < ring.vertices.rows(); root += 7) {
        const std::vector<HandleLoop<double>> all = handle_loops(creases, root);
        const std::vector<HandleLoop<double>> within = handle_loops(creases, root, 1.5 * 2 * pi * 0.2);
        REQUIRE(within.size() == 1);
        CHECK(within.front().vertices == all.front().vertices);
        CHECK(within.front().length == all.front().length);
        CHECK(handle_loops(creases, root, 0.7 * 2 * pi * 0.2).empty());
    }
}

TEST_CASE("cut along either of its loops a torus is a closed surface without a handle") {
    const Mesh ring = torus(1, 0.2);
    const Triangles adjacency = face_adjacency(ring.faces);
    for (const HandleLoop<double>& loop : handle_loops(crease_graph(ring, adjacency), 5)) {
        const CutSurface<double> cut = cut_along(ring, adjacency, {loop.vertices});
        CHECK(is_closed(cut.mesh.faces));
        CHECK(genus(cut.mesh) == 0);
        CHECK(std::count(cut.source.begin(), cut.source.end(), -1) == 2);
        CHECK(cut.mesh.vertices.rows() == ring.vertices.rows() + static_cast<Eigen::Index>(loop.vertices.size()) + 2);
        CHECK(enclosed_volume(cut.mesh) > 0.95 * enclosed_volume(ring));
        CHECK(enclosed_volume(cut.mesh) < 1.2 * enclosed_volume(ring)); // the hole's two lids are apart
    }
}

TEST_CASE("in a crease of a right angle a fifth of the length counts, on ridges and flat ground all of it") {
    Mesh block; // an L of height 1, whose inner edge is that from corner 3 to 9
    block.vertices.resize(12, 3);
    for (const int z : {0, 1})
        block.vertices.middleRows(6 * z, 6) << 0, 0, z, 2, 0, z, 2, 1, z, 1, 1, z, 1, 2, z, 0, 2, z;
    block.faces.resize(20, 3);
    block.faces.topRows(8) << 0, 3, 1, 1, 3, 2, 0, 5, 3, 3, 5, 4, 6, 7, 9, 7, 8, 9, 6, 9, 11, 9, 10, 11;
    for (int k = 0; k < 6; ++k) {
        const int next = (k + 1) % 6;
        block.faces.row(8 + 2 * k) << k, next, next + 6;
        block.faces.row(9 + 2 * k) << k, next + 6, k + 6;
    }
    REQUIRE(enclosed_volume(block) == Approx(3));
    const std::vector<double> factors = crease_graph(block, face_adjacency(block.faces)).factors;
    for (std::size_t v = 0; v < factors.size(); ++v) CHECK(factors[v] == Approx(v % 6 == 3 ? 0.2 : 1));
}

TEST_CASE("a thin ring is opened, a thick one is not") {
    const Body<double> ring = prepare(torus(1, 0.005));
    const auto opened = open_handles(ring);
    REQUIRE(opened);
    const Body<double>& body = *opened;
    CHECK(genus(body.mesh) == 0);
    CHECK(is_closed(body.mesh.faces));
    REQUIRE(body.repairs.size() == 1);
    CHECK(body.repairs.front() == "the body has grown together with itself in 1 place: it was opened there");
    REQUIRE(body.source.size() == static_cast<std::size_t>(body.mesh.vertices.rows()));
    for (std::size_t v = 0; v < ring.source.size(); ++v) CHECK(body.source[v] == ring.source[v]);

    CHECK_FALSE(open_handles(prepare(torus(1, 0.2))));
}

TEST_CASE("a notch around a ring is a crease to open it along") {
    constexpr int around = 256, tube = 24;
    Mesh notched = torus(1, 0.05, around, tube);
    for (int k = 0; k < tube; ++k) // the tube's circle at (1, 0, 0), half as wide: a girth of 0.112 for unit area
        notched.vertices.row(k) = 0.5 * (notched.vertices.row(k) + Eigen::RowVector3d(1, 0, 0));
    const Body<double> ring = prepare(notched);
    REQUIRE(ring.mesh.vertices.rows() == notched.vertices.rows());
    const auto along_notch = open_handles(ring);
    REQUIRE(along_notch);
    CHECK(genus(along_notch->mesh) == 0);
    CHECK_FALSE(open_handles(prepare(torus(1, 0.05, around, tube)))); // a girth of 0.22
}

TEST_CASE("handles that are far apart are opened, each once") {
    std::vector<std::array<Vec3, 2>> segments{{Vec3(0, 0, 0), Vec3(2, 0.1, 0)}}; // with a ring at either end
    for (const double x : {-1.0, 2.0}) {
        const std::array<Vec3, 4> corners{Vec3(x, 0, 0), Vec3(x, 1, 0), Vec3(x + 1, 1.1, 0), Vec3(x + 1, 0.1, 0)};
        for (std::size_t k = 0; k < 4; ++k) segments.push_back({corners[k], corners[(k + 1) % 4]});
    }
    segments[0][0] = Vec3(0, 0.1, 0);
    segments[0][1] = Vec3(2, 0, 0);
    const Body<double> rings = prepare(tubes(segments, 0.012, 0.007));
    REQUIRE(genus(rings.mesh) == 2);
    const auto opened = open_handles(rings);
    REQUIRE(opened);
    CHECK(genus(opened->mesh) == 0);
    CHECK(opened->is_closed);
    CHECK(surface_area(opened->mesh) > 0.97 * surface_area(rings.mesh)); // nothing was cut off
    CHECK(opened->repairs.back() == "the body has grown together with itself in 2 places: it was opened there");
}

TEST_CASE("a body without handles has nothing to open") { CHECK_FALSE(open_handles(prepare(sphere(1)))); }
