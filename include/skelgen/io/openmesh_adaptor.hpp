#pragma once

// To and from OpenMesh. Only programs that use OpenMesh themselves include this header.

#include <cstddef>
#include <string>
#include <vector>

#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include <skelgen/core/error.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/io/polygon_mesh.hpp>

namespace skelgen {

/// The mesh of any OpenMesh TriMesh or PolyMesh with three-dimensional points. Vertices and faces keep their order;
/// deleted ones are left out and the indices close up. Polygons are cut as by `triangulate`. Linear.
/// \throws Error bad_input as `triangulate`.
template <typename Scalar = double, typename Kernel>
[[nodiscard]] TriangleMesh<Scalar> to_triangle_mesh(const OpenMesh::PolyMeshT<Kernel>& mesh) {
    PolygonMesh polygons;
    std::vector<int> index(mesh.n_vertices(), -1);
    int next = 0;
    for (auto vertex = mesh.vertices_sbegin(); vertex != mesh.vertices_end(); ++vertex) {
        index[static_cast<std::size_t>(vertex->idx())] = next++;
        const auto& point = mesh.point(*vertex);
        for (unsigned axis = 0; axis < 3; ++axis) polygons.coordinates.push_back(static_cast<double>(point[axis]));
    }
    for (auto face = mesh.faces_sbegin(); face != mesh.faces_end(); ++face) {
        const std::size_t first = polygons.corners.size();
        for (auto vertex = mesh.cfv_ccwbegin(*face); vertex != mesh.cfv_ccwend(*face); ++vertex)
            polygons.corners.push_back(index[static_cast<std::size_t>(vertex->idx())]);
        polygons.sizes.push_back(static_cast<int>(polygons.corners.size() - first));
    }
    return triangulate<Scalar>(polygons);
}

/// An OpenMesh mesh (`Mesh` is a TriMesh or PolyMesh type) with the same vertex and face indices. Linear.
/// \throws Error bad_input when a half-edge mesh cannot hold a face: where three faces meet at an edge, neighbours are
///         turned against each other, or fans of faces touch in one vertex in an order that OpenMesh cannot link.
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
        if (!handle.is_valid())
            throw Error(ErrorCode::bad_input,
                        "face " + std::to_string(i) +
                            " (counted from 0) does not fit into a half-edge mesh: the surface is "
                            "not manifold or not consistently turned there; repair it");
    }
    return result;
}

} // namespace skelgen
