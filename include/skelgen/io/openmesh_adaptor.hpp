#pragma once

// To and from OpenMesh. Only programs that use OpenMesh themselves include this header.

#include <cstddef>

#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include <skelgen/core/mesh.hpp>
#include <skelgen/io/half_edge_mesh.hpp>
#include <skelgen/io/polygon_mesh.hpp>

namespace skelgen::io {

/// The mesh of any OpenMesh TriMesh or PolyMesh with three-dimensional points. Vertices and faces keep their order;
/// deleted ones are left out and the indices close up. Polygons are cut as by `triangulate`. Linear.
/// \throws Error bad_input as `triangulate`.
template <typename Scalar = double, typename Kernel>
[[nodiscard]] TriangleMesh<Scalar> to_triangle_mesh(const OpenMesh::PolyMeshT<Kernel>& mesh) {
    detail::PolygonCollector collector(mesh.n_vertices());
    for (auto vertex = mesh.vertices_sbegin(); vertex != mesh.vertices_end(); ++vertex) {
        const auto& point = mesh.point(*vertex);
        collector.add_vertex(vertex->idx(), static_cast<double>(point[0]), static_cast<double>(point[1]),
                             static_cast<double>(point[2]));
    }
    for (auto face = mesh.faces_sbegin(); face != mesh.faces_end(); ++face) {
        for (auto vertex = mesh.cfv_ccwbegin(*face); vertex != mesh.cfv_ccwend(*face); ++vertex)
            collector.add_corner(vertex->idx());
        collector.end_face();
    }
    return triangulate<Scalar>(collector.polygons());
}

/// An OpenMesh mesh (`Mesh` is a TriMesh or PolyMesh type) with the same vertex and face indices. Linear. \throws Error
/// bad_input when a half-edge mesh cannot hold a face. That is so where three faces meet at an edge, neighbours are
/// turned against each other, or fans of faces touch in a vertex so that OpenMesh cannot link them.
template <typename Mesh, typename Scalar>
[[nodiscard]] Mesh to_openmesh(const TriangleMesh<Scalar>& mesh) {
    using Point = typename Mesh::Point;
    using Coordinate = typename OpenMesh::vector_traits<Point>::value_type;
    Mesh result;
    const auto vertices = static_cast<std::size_t>(mesh.vertices.rows());
    const auto faces = static_cast<std::size_t>(mesh.faces.rows());
    result.reserve(vertices, vertices + faces, faces);
    for (Eigen::Index i = 0; i < mesh.vertices.rows(); ++i)
        result.add_vertex(Point(static_cast<Coordinate>(mesh.vertices(i, 0)),
                                static_cast<Coordinate>(mesh.vertices(i, 1)),
                                static_cast<Coordinate>(mesh.vertices(i, 2))));
    for (Eigen::Index i = 0; i < mesh.faces.rows(); ++i) {
        const auto handle =
            result.add_face(OpenMesh::VertexHandle(mesh.faces(i, 0)), OpenMesh::VertexHandle(mesh.faces(i, 1)),
                            OpenMesh::VertexHandle(mesh.faces(i, 2)));
        if (!handle.is_valid()) detail::throw_no_half_edge_face(i);
    }
    return result;
}

} // namespace skelgen::io

namespace skelgen {
using io::to_openmesh;
using io::to_triangle_mesh;
} // namespace skelgen
