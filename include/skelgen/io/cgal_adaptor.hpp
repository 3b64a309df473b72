#pragma once

// To and from CGAL::Surface_mesh. Only programs that use CGAL themselves include this header.

#include <cstddef>
#include <string>
#include <vector>

#include <CGAL/Surface_mesh.h>
#include <CGAL/number_utils.h>

#include <skelgen/core/error.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/io/polygon_mesh.hpp>

namespace skelgen {

/// The mesh of a CGAL::Surface_mesh over any kernel's Point_3. Vertices and faces keep their order; removed ones are
/// left out and the indices close up. Polygons are cut as by `triangulate`. Linear.
/// \throws Error bad_input as `triangulate`.
template <typename Scalar = double, typename Point>
[[nodiscard]] TriangleMesh<Scalar> to_triangle_mesh(const CGAL::Surface_mesh<Point>& mesh) {
    PolygonMesh polygons;
    std::vector<int> index(mesh.number_of_vertices() + mesh.number_of_removed_vertices(), -1);
    int next = 0;
    for (const auto vertex : mesh.vertices()) {
        index[static_cast<std::size_t>(vertex.idx())] = next++;
        const Point& point = mesh.point(vertex);
        for (int axis = 0; axis < 3; ++axis) polygons.coordinates.push_back(CGAL::to_double(point[axis]));
    }
    for (const auto face : mesh.faces()) {
        const std::size_t first = polygons.corners.size();
        for (const auto vertex : mesh.vertices_around_face(mesh.halfedge(face)))
            polygons.corners.push_back(index[static_cast<std::size_t>(vertex.idx())]);
        polygons.sizes.push_back(static_cast<int>(polygons.corners.size() - first));
    }
    return triangulate<Scalar>(polygons);
}

/// A CGAL::Surface_mesh with the same vertex and face indices. Linear.
/// \throws Error bad_input when a half-edge mesh cannot hold a face: where three faces meet at an edge, neighbours are
///         turned against each other, or fans of faces touch in one vertex in an order that CGAL cannot link.
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
            throw Error(ErrorCode::bad_input,
                        "face " + std::to_string(i) +
                            " (counted from 0) does not fit into a half-edge mesh: the surface is "
                            "not manifold or not consistently turned there; repair it");
    return result;
}

} // namespace skelgen
