#include <algorithm>
#include <array>
#include <vector>

#include <skelgen/core/adjacency.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/curve/impl/half_edges.hpp>

#include "catch.hpp"
#include "curve/throws.hpp"
#include "shapes.hpp"

using namespace skelgen;
using namespace skelgen::core;
using namespace skelgen::curve;
using namespace skelgen::test;

namespace {

HalfEdges half_edges(const Mesh& mesh) { return {mesh.vertices, mesh.faces}; }

/// The surface that is there after `remove_deleted`.
Mesh mesh_of(const HalfEdges& surface) {
    Mesh mesh;
    mesh.vertices.resize(surface.vertices(), 3);
    for (int v = 0; v < surface.vertices(); ++v) set_point<double>(mesh.vertices, v, surface.place(v));
    mesh.faces = surface.triangles();
    return mesh;
}

int boundary_edges(const HalfEdges& surface) {
    int count = 0;
    for (int e = 0; e < surface.edges(); ++e) count += surface.is_boundary_edge(e);
    return count;
}

/// Every link leads back, every triangle closes, and every vertex is where its edges begin.
void check_links(const HalfEdges& surface) {
    for (int side = 0; side < 2 * surface.edges(); ++side) {
        CHECK(surface.from(surface.next(side)) == surface.to(side));
        if (!surface.is_boundary(side)) CHECK(surface.next(surface.next(surface.next(side))) == side);
    }
    std::size_t met = 0;
    for (int v = 0; v < surface.vertices(); ++v)
        surface.any_around(v, [&](int side) {
            CHECK(surface.from(side) == v);
            ++met;
            return false;
        });
    CHECK(met == static_cast<std::size_t>(2 * surface.edges()));
    for (int f = 0; f < surface.faces(); ++f) CHECK_FALSE(surface.is_boundary(surface.side_of_face(f)));
}

/// Two triangles over the edge from 0 to 2.
Mesh square() { return make_mesh({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}); }

int inner_edge(const HalfEdges& surface) {
    for (int e = 0; e < surface.edges(); ++e)
        if (!surface.is_boundary_edge(e)) return e;
    return -1;
}

} // namespace

TEST_CASE("half-edges keep vertices and faces as they are given") {
    for (const Mesh& mesh : {sphere(1, 2), torus(1, 0.3, 20, 10), square()}) {
        const HalfEdges surface = half_edges(mesh);
        check_links(surface);
        CHECK(mesh_of(surface).vertices == mesh.vertices);
        CHECK(surface.triangles() == mesh.faces);
        CHECK(surface.edges() == (3 * surface.faces() + boundary_edges(surface)) / 2);
        CHECK(surface.source(2) == 2);
    }
    CHECK(boundary_edges(half_edges(square())) == 4);
    CHECK(half_edges(square()).is_boundary_vertex(0));
    CHECK_FALSE(half_edges(sphere(1, 1)).is_boundary_vertex(0));
}

TEST_CASE("half-edges hold manifold surfaces only") {
    const Mesh fin =
        make_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}}, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}});
    const Mesh opposed = make_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}}, {{0, 1, 2}, {0, 1, 3}});
    const Mesh bow_tie = make_mesh({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}}, {{0, 1, 2}, {0, 3, 4}});
    Mesh pinched = sphere(1, 2);
    for (Eigen::Index i = 0; i < pinched.faces.size(); ++i)
        if (pinched.faces.data()[i] == static_cast<int>(pinched.vertices.rows()) - 1) pinched.faces.data()[i] = 0;
    for (const Mesh& mesh : {fin, opposed, bow_tie, pinched})
        CHECK(throws(ErrorCode::bad_input, [&] { (void)half_edges(mesh); }));
}

TEST_CASE("an edge that is split divides the faces beside it, inside and at the boundary") {
    for (const int edge : {0, inner_edge(half_edges(square()))}) {
        HalfEdges surface = half_edges(square());
        const bool inside = !surface.is_boundary_edge(edge);
        const Vec3 middle = (surface.place(surface.from(2 * edge)) + surface.place(surface.to(2 * edge))) / 2;
        surface.split(edge, middle);
        check_links(surface);
        CHECK(surface.faces() == (inside ? 4 : 3));
        CHECK(surface.vertices() == 5);
        CHECK(surface.source(4) == -1);
        CHECK(surface.place(4) == middle);
        CHECK(surface_area(mesh_of(surface)) == Approx(1));
        CHECK(boundary_edges(surface) == (inside ? 4 : 5));
    }
}

TEST_CASE("a flipped edge joins the two corners that it has parted") {
    HalfEdges surface = half_edges(square());
    const int edge = inner_edge(surface);
    CHECK_FALSE(surface.may_flip(edge == 0 ? 1 : 0)); // on the boundary
    REQUIRE(surface.may_flip(edge));
    surface.flip(edge);
    check_links(surface);
    CHECK(std::min(surface.from(2 * edge), surface.to(2 * edge)) == 1);
    CHECK(std::max(surface.from(2 * edge), surface.to(2 * edge)) == 3);
    CHECK(surface_area(mesh_of(surface)) == Approx(1));

    const Mesh tetrahedron =
        make_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}});
    const HalfEdges whole = half_edges(tetrahedron);
    for (int e = 0; e < whole.edges(); ++e) CHECK_FALSE(whole.may_flip(e)); // all corners are joined
}

TEST_CASE("collapses that may be done leave a manifold of the same kind, down to few vertices") {
    for (const Mesh& mesh : {sphere(1, 2), torus(1, 0.3, 12, 8)}) {
        HalfEdges surface = half_edges(mesh);
        const int euler = surface.vertices() - surface.edges() + surface.faces();
        bool any = true;
        while (any) {
            any = false;
            for (int e = 0; e < surface.edges(); ++e) {
                if (surface.is_deleted(e) || !surface.may_collapse(2 * e)) continue;
                surface.collapse(2 * e);
                any = true;
            }
            surface.remove_deleted();
            check_links(surface);
            CHECK(surface.vertices() - surface.edges() + surface.faces() == euler);
            CHECK(boundary_edges(surface) == 0);
            CHECK_NOTHROW(half_edges(mesh_of(surface)));
        }
        CHECK(surface.vertices() < 12);
    }
}
