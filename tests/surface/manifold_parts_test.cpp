#include <algorithm>
#include <numeric>
#include <vector>

#include <skelgen/core/geometry.hpp>
#include <skelgen/surface/manifold_parts.hpp>

#include "catch.hpp"
#include "mesh_changes.hpp"
#include "shapes.hpp"

using namespace skelgen;
using namespace skelgen::core;
using namespace skelgen::surface;
using namespace skelgen::test;

namespace {

/// `mesh` with vertex `from` replaced by `to` in all faces.
Mesh joined(Mesh mesh, int from, int to) {
    mesh.faces = (mesh.faces.array() == from).select(to, mesh.faces);
    return mesh;
}

void check_sources(const ManifoldParts<double>& parts, const Mesh& mesh) {
    REQUIRE(parts.source.size() == static_cast<std::size_t>(parts.mesh.vertices.rows()));
    for (std::size_t v = 0; v < parts.source.size(); ++v)
        REQUIRE(parts.mesh.vertices.row(static_cast<Eigen::Index>(v)) == mesh.vertices.row(parts.source[v]));
}

} // namespace

TEST_CASE("a sound mesh comes through whole") {
    const Mesh mesh = torus(1, 0.3);
    const ManifoldParts<double> parts = largest_manifold_part(mesh);
    CHECK(parts.dropped_pieces == 0);
    CHECK(parts.mesh.vertices.rows() == mesh.vertices.rows());
    CHECK(parts.mesh.faces.rows() == mesh.faces.rows());
    CHECK(euler_characteristic(parts.mesh.faces) == 0);
    CHECK(is_closed(parts.mesh.faces));
    check_sources(parts, mesh);
}

TEST_CASE("a vertex where two fans of one surface touch becomes two") {
    // Two vertices of a sphere that are no neighbours made one: Euler characteristic 1, as of SCAPE's bodies.
    const Mesh pinched = joined(sphere(1, 3), 3, 0);
    REQUIRE(euler_characteristic(pinched.faces) == 1);
    const ManifoldParts<double> parts = largest_manifold_part(pinched);
    CHECK(parts.dropped_pieces == 0);
    CHECK(parts.mesh.faces.rows() == pinched.faces.rows());
    CHECK(euler_characteristic(parts.mesh.faces) == 2);
    CHECK(is_closed(parts.mesh.faces));
    CHECK(std::count(parts.source.begin(), parts.source.end(), 0) == 2);
    check_sources(parts, pinched);
}

TEST_CASE("of a sound mesh the same part is found without looking for pieces") {
    for (const Mesh& mesh : {torus(1, 0.3), joined(sphere(1, 3), 3, 0), shuffled(torus(1, 0.3), 5)}) {
        const ManifoldParts<double> expected = largest_manifold_part(mesh), parts = manifold_part_of_sound(mesh);
        CHECK(parts.mesh.faces == expected.mesh.faces);
        CHECK(parts.mesh.vertices == expected.mesh.vertices);
        CHECK(parts.source == expected.source);
    }
}

TEST_CASE("two surfaces that touch in a vertex are two pieces") {
    const Mesh large = sphere(2, 3), small = sphere(1, 3);
    const Mesh touching = joined(side_by_side(large, small), static_cast<int>(large.vertices.rows()), 0);
    const ManifoldParts<double> parts = largest_manifold_part(touching);
    CHECK(parts.dropped_pieces == 1);
    CHECK(parts.mesh.faces.rows() == large.faces.rows());
    CHECK(is_closed(parts.mesh.faces));
}

TEST_CASE("of several pieces the one with the largest area stays and the others are counted") {
    const Mesh small = sphere(0.5, 4), large = sphere(1, 2);
    Mesh mesh = side_by_side(side_by_side(small, large), small); // the small ones have more faces
    for (const int seed : {1, 2, 3}) {
        const ManifoldParts<double> parts = largest_manifold_part(shuffled(mesh, static_cast<unsigned>(seed)));
        CHECK(parts.dropped_pieces == 2);
        CHECK(parts.mesh.faces.rows() == large.faces.rows());
        CHECK(surface_area(parts.mesh) == Approx(surface_area(large)));
    }
}

TEST_CASE("a fin on an edge is cut off and the edge healed") {
    Mesh fin = sphere(1, 2);
    const int a = fin.faces(0, 0), b = fin.faces(0, 1), tip = static_cast<int>(fin.vertices.rows());
    fin.vertices.conservativeResize(tip + 1, 3);
    fin.vertices.row(tip) = 2 * fin.vertices.row(a);
    fin.faces.conservativeResize(fin.faces.rows() + 1, 3);
    fin.faces.bottomRows<1>() << a, b, tip;
    const ManifoldParts<double> parts = largest_manifold_part(fin);
    CHECK(parts.dropped_pieces == 1); // the fin
    CHECK(parts.mesh.faces.rows() == fin.faces.rows() - 1);
    CHECK(is_closed(parts.mesh.faces));
    CHECK(euler_characteristic(parts.mesh.faces) == 2);
}

TEST_CASE("faces that repeat a vertex are left out and open nothing") {
    Mesh mesh = sphere(1, 2);
    mesh.faces.conservativeResize(mesh.faces.rows() + 1, 3);
    mesh.faces.bottomRows<1>() << 4, 4, 7;
    const ManifoldParts<double> parts = largest_manifold_part(mesh);
    CHECK(parts.mesh.faces.rows() == mesh.faces.rows() - 1);
    CHECK(is_closed(parts.mesh.faces));
}

TEST_CASE("faces that turn against their neighbours are cut off") {
    Mesh mesh = sphere(1, 3);
    std::swap(mesh.faces(17, 0), mesh.faces(17, 1));
    const ManifoldParts<double> parts = largest_manifold_part(mesh);
    CHECK(parts.dropped_pieces == 1);
    CHECK(parts.mesh.faces.rows() == mesh.faces.rows() - 1);
}

TEST_CASE("all pieces come out, the one with the largest area first, of equals that of the first face") {
    const Mesh small = sphere(0.5, 3), large = sphere(1, 2), ring = torus(2, 0.05, 24, 6);
    REQUIRE(surface_area(large) > surface_area(ring));
    REQUIRE(surface_area(ring) > surface_area(small));
    const Mesh mesh = side_by_side(side_by_side(small, ring), side_by_side(small, large));
    const std::vector<ManifoldParts<double>> parts = manifold_parts(mesh);
    REQUIRE(parts.size() == 4);
    CHECK(parts[0].mesh.faces.rows() == large.faces.rows());
    CHECK(euler_characteristic(parts[1].mesh.faces) == 0);
    CHECK(parts[2].mesh.faces.rows() == small.faces.rows());
    CHECK(*std::min_element(parts[2].source.begin(), parts[2].source.end()) == 0);
    CHECK(*std::min_element(parts[3].source.begin(), parts[3].source.end()) ==
          small.vertices.rows() + ring.vertices.rows());
    for (const ManifoldParts<double>& part : parts) {
        CHECK(part.dropped_pieces == 0);
        CHECK(is_closed(part.mesh.faces));
        check_sources(part, mesh);
    }
}

TEST_CASE("every vertex of separate pieces is the source of one") {
    const Mesh mesh = shuffled(side_by_side(sphere(1, 3), torus(2, 0.3)), 4);
    std::vector<int> sources;
    for (const ManifoldParts<double>& part : manifold_parts(mesh)) {
        check_sources(part, mesh);
        sources.insert(sources.end(), part.source.begin(), part.source.end());
    }
    std::sort(sources.begin(), sources.end());
    std::vector<int> all(static_cast<std::size_t>(mesh.vertices.rows()));
    std::iota(all.begin(), all.end(), 0);
    CHECK(sources == all);
}

TEST_CASE("pieces with less than a part of the largest one's area are left out") {
    const Mesh mesh = side_by_side(side_by_side(sphere(0.5, 3), sphere(1, 3)), sphere(0.1, 1)); // areas 1/4, 1, < 1/100
    const auto count = [&](double least_area) { return manifold_parts(mesh, least_area).size(); };
    CHECK(count(0) == 3);
    CHECK(count(0.001) == 3);
    CHECK(count(0.01) == 2);
    CHECK(count(0.24) == 2);
    CHECK(count(0.26) == 1);
    CHECK(count(1) == 1);
    CHECK(manifold_parts(mesh, 1).front().mesh.vertices.rows() == sphere(1, 3).vertices.rows());
}

TEST_CASE("two surfaces that touch in a vertex both come out, each with that vertex") {
    const Mesh large = sphere(2, 3), small = sphere(1, 3);
    const Mesh touching = joined(side_by_side(large, small), static_cast<int>(large.vertices.rows()), 0);
    const std::vector<ManifoldParts<double>> parts = manifold_parts(touching);
    REQUIRE(parts.size() == 2);
    for (const ManifoldParts<double>& part : parts) {
        CHECK(std::count(part.source.begin(), part.source.end(), 0) == 1);
        CHECK(is_closed(part.mesh.faces));
        check_sources(part, touching);
    }
    const ManifoldParts<double> largest = largest_manifold_part(touching);
    CHECK(parts[0].source == largest.source);
    CHECK(parts[0].mesh.faces == largest.mesh.faces);
}

TEST_CASE("a mesh without faces has no pieces") {
    CHECK(manifold_parts(make_mesh({{0, 0, 0}}, {})).empty());
    CHECK(largest_manifold_part(make_mesh({{0, 0, 0}}, {})).mesh.faces.rows() == 0);
}
