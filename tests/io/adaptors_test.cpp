#include <algorithm>
#include <utility>
#include <vector>

#include <CGAL/Simple_cartesian.h>

#include <skelgen/io/cgal_adaptor.hpp>
#include <skelgen/io/openmesh_adaptor.hpp>

#include "mesh_expectations.hpp"

using namespace skelgen;
using namespace skelgen::io;
using namespace skelgen::test;

namespace {

struct DoubleTraits : OpenMesh::DefaultTraits {
    using Point = OpenMesh::Vec3d;
    VertexAttributes(OpenMesh::Attributes::Status);
    EdgeAttributes(OpenMesh::Attributes::Status);
    HalfedgeAttributes(OpenMesh::Attributes::Status);
    FaceAttributes(OpenMesh::Attributes::Status);
};
using OpenTriangles = OpenMesh::TriMesh_ArrayKernelT<DoubleTraits>;
using OpenPolygons = OpenMesh::PolyMesh_ArrayKernelT<>; // float points, no status: nothing can be deleted

using CgalPoint = CGAL::Simple_cartesian<double>::Point_3;
using CgalFloatPoint = CGAL::Simple_cartesian<float>::Point_3;
using CgalMesh = CGAL::Surface_mesh<CgalPoint>;

/// Faces name vertices in another cyclic order after some round trips; the triangles are the same.
Triangles with_least_corner_first(Triangles faces) {
    for (auto face : faces.rowwise()) std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
    return faces;
}

void check_equal(const TriangleMesh<double>& mesh, const TriangleMesh<double>& expected) {
    CHECK(mesh.vertices == expected.vertices);
    CHECK(with_least_corner_first(mesh.faces) == with_least_corner_first(expected.faces));
}

/// Three triangles at one edge.
TriangleMesh<double> fan_of_three_at_an_edge() {
    TriangleMesh<double> mesh = tetrahedron();
    mesh.vertices.conservativeResize(5, 3);
    mesh.vertices.row(4) << 1, 1, 1;
    mesh.faces.conservativeResize(5, 3);
    mesh.faces.row(4) << 0, 1, 4;
    return mesh;
}

} // namespace

TEST_CASE("OpenMesh: there and back", "[io][adaptors]") {
    check_equal(to_triangle_mesh(to_openmesh<OpenTriangles>(tetrahedron())), tetrahedron());
    check_equal(to_triangle_mesh(to_openmesh<OpenPolygons>(tetrahedron())), tetrahedron());
    const TriangleMesh<float> single = to_triangle_mesh<float>(to_openmesh<OpenTriangles>(tetrahedron()));
    CHECK(single.vertices == tetrahedron().vertices.cast<float>());
    CHECK(to_openmesh<OpenTriangles>(single).n_edges() == 6);
}

TEST_CASE("OpenMesh: polygons are cut", "[io][adaptors]") {
    OpenPolygons square;
    std::vector<OpenMesh::VertexHandle> corners;
    for (const auto& [x, y] : {std::pair{0.F, 0.F}, {2.F, -3.F}, {4.F, 0.F}, {2.F, 3.F}})
        corners.push_back(square.add_vertex({x, y, 0}));
    square.add_face(corners);
    const TriangleMesh<double> mesh = to_triangle_mesh(square);
    Triangles expected(2, 3);
    expected << 0, 1, 2, 0, 2, 3;
    CHECK(with_least_corner_first(mesh.faces) == expected);
}

TEST_CASE("OpenMesh: deleted elements are left out", "[io][adaptors]") {
    OpenTriangles mesh = to_openmesh<OpenTriangles>(tetrahedron());
    mesh.delete_vertex(OpenMesh::VertexHandle(0)); // and the three faces around it
    const TriangleMesh<double> rest = to_triangle_mesh(mesh);
    TriangleMesh<double> expected;
    expected.vertices = tetrahedron().vertices.bottomRows(3);
    expected.faces.resize(1, 3);
    expected.faces << 0, 1, 2;
    check_equal(rest, expected);
}

TEST_CASE("CGAL: there and back", "[io][adaptors]") {
    check_equal(to_triangle_mesh(to_cgal<CgalPoint>(tetrahedron())), tetrahedron());
    check_equal(to_triangle_mesh(to_cgal<CgalFloatPoint>(tetrahedron())), tetrahedron());
    CHECK(to_triangle_mesh<float>(to_cgal<CgalPoint>(tetrahedron())).vertices == tetrahedron().vertices.cast<float>());
}

TEST_CASE("CGAL: polygons are cut, removed elements left out", "[io][adaptors]") {
    CgalMesh mesh;
    const auto stray = mesh.add_vertex({9, 9, 9});
    const auto a = mesh.add_vertex({0, 0, 0}), b = mesh.add_vertex({2, -3, 0}), c = mesh.add_vertex({4, 0, 0}),
               d = mesh.add_vertex({2, 3, 0});
    mesh.add_face(a, b, c, d);
    mesh.remove_vertex(stray);
    const TriangleMesh<double> result = to_triangle_mesh(mesh);
    Triangles expected(2, 3);
    expected << 0, 1, 2, 0, 2, 3;
    CHECK(with_least_corner_first(result.faces) == expected);
    CHECK(result.vertices.row(0).isZero());
    CHECK(result.vertices.rows() == 4);
}

TEST_CASE("adaptors: a surface that no half-edge mesh can hold is refused, not changed", "[io][adaptors]") {
    CHECK_THROWS_AS(to_openmesh<OpenTriangles>(fan_of_three_at_an_edge()), Error);
    CHECK_THROWS_AS(to_cgal<CgalPoint>(fan_of_three_at_an_edge()), Error);
}

TEST_CASE("adaptors: empty meshes are refused", "[io][adaptors]") {
    CHECK_THROWS_AS(to_triangle_mesh(OpenTriangles()), Error);
    CHECK_THROWS_AS(to_triangle_mesh(CgalMesh()), Error);
}
