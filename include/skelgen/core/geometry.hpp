#pragma once

#include <skelgen/core/mesh.hpp>
#include <skelgen/core/precision.hpp>

namespace skelgen::core {

/// Area vector of triangle `f`: normal times area, outward for counter-clockwise faces.
template <typename Scalar>
[[nodiscard]] Vector3<Scalar> face_area_vector(const TriangleMesh<Scalar>& mesh, Eigen::Index f) {
    const Vector3<Scalar> a = mesh.vertices.row(mesh.faces(f, 0));
    const Vector3<Scalar> b = mesh.vertices.row(mesh.faces(f, 1));
    const Vector3<Scalar> c = mesh.vertices.row(mesh.faces(f, 2));
    return Scalar(0.5) * (b - a).cross(c - a);
}

/// Total area of the surface. O(faces).
template <typename Scalar>
[[nodiscard]] Scalar surface_area(const TriangleMesh<Scalar>& mesh) {
    Accumulator area = 0;
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) area += face_area_vector(mesh, f).norm();
    return static_cast<Scalar>(area);
}

/// Signed volume enclosed by the surface (positive for outward faces); meaningful for closed surfaces. O(faces).
template <typename Scalar>
[[nodiscard]] Scalar enclosed_volume(const TriangleMesh<Scalar>& mesh) {
    Accumulator volume = 0;
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f)
        volume += face_area_vector(mesh, f).dot(mesh.vertices.row(mesh.faces(f, 0)).transpose());
    return static_cast<Scalar>(volume / 3);
}

/// Area-weighted unit vertex normals, n x 3; zero rows for vertices without area. O(n + faces).
template <typename Scalar>
[[nodiscard]] Points<Scalar> vertex_normals(const TriangleMesh<Scalar>& mesh);

/// Generalized winding number of the surface around a point: 1 inside, 0 outside a closed outward surface, in between
/// near holes (JKS13): the sum of the faces' solid angles (OS83). O(faces).
template <typename Scalar>
[[nodiscard]] Scalar winding_number(const TriangleMesh<Scalar>& mesh, const Vector3<Scalar>& point);

/// Vertex of the mesh nearest to a point, the first of equals; the mesh must have one. O(n).
template <typename Scalar>
[[nodiscard]] int nearest_vertex(const TriangleMesh<Scalar>& mesh, const Vector3<Scalar>& point);

} // namespace skelgen::core

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/core/impl/geometry.hpp>
#endif
