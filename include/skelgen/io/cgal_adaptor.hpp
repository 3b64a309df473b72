#pragma once

// To and from CGAL::Surface_mesh. Only programs that use CGAL themselves include this header.

#include <CGAL/Surface_mesh.h>
#include <CGAL/number_utils.h>

#include <skelgen/core/mesh.hpp>
#include <skelgen/io/half_edge_mesh.hpp>
#include <skelgen/io/polygon_mesh.hpp>

namespace skelgen::io {

/// The mesh of a CGAL::Surface_mesh over any kernel's Point_3. Vertices and faces keep their order; removed ones are
/// left out and the indices close up. Polygons are cut as by `triangulate`. Linear.
/// \throws Error bad_input as `triangulate`.
template <typename Scalar = double, typename Point>
[[nodiscard]] TriangleMesh<Scalar> to_triangle_mesh(const CGAL::Surface_mesh<Point>& mesh) {
    detail::PolygonCollector collector(mesh.number_of_vertices() + mesh.number_of_removed_vertices());
    const auto index = [](auto vertex) { return static_cast<int>(vertex.idx()); };
    for (const auto vertex : mesh.vertices()) {
        const Point& point = mesh.point(vertex);
        collector.add_vertex(index(vertex), CGAL::to_double(point[0]), CGAL::to_double(point[1]),
                             CGAL::to_double(point[2]));
    }
    for (const auto face : mesh.faces()) {
        for (const auto vertex : mesh.vertices_around_face(mesh.halfedge(face))) collector.add_corner(index(vertex));
        collector.end_face();
    }
    return triangulate<Scalar>(collector.polygons());
}

/// A CGAL::Surface_mesh with the same vertex and face indices. Linear. \throws Error bad_input when a half-edge mesh
/// cannot hold a face. That is so where three faces meet at an edge, neighbours are turned against each other, or fans
/// of faces touch in a vertex so that CGAL cannot link them.
template <typename Point, typename Scalar>
[[nodiscard]] CGAL::Surface_mesh<Point> to_cgal(const TriangleMesh<Scalar>& mesh) {
    using Mesh = CGAL::Surface_mesh<Point>;
    using Vertex = typename Mesh::Vertex_index;
    Mesh result;
    const auto vertices = static_cast<typename Mesh::size_type>(mesh.vertices.rows());
    const auto faces = static_cast<typename Mesh::size_type>(mesh.faces.rows());
    result.reserve(vertices, vertices + faces, faces);
    for (Eigen::Index i = 0; i < mesh.vertices.rows(); ++i)
        result.add_vertex(Point(mesh.vertices(i, 0), mesh.vertices(i, 1), mesh.vertices(i, 2)));
    const auto vertex = [&mesh](Eigen::Index face, int corner) {
        return Vertex(static_cast<typename Mesh::size_type>(mesh.faces(face, corner)));
    };
    for (Eigen::Index i = 0; i < mesh.faces.rows(); ++i)
        if (result.add_face(vertex(i, 0), vertex(i, 1), vertex(i, 2)) == Mesh::null_face())
            detail::throw_no_half_edge_face(i);
    return result;
}

} // namespace skelgen::io

namespace skelgen {
using io::to_cgal;
using io::to_triangle_mesh;
} // namespace skelgen
