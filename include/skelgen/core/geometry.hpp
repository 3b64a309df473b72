#pragma once

#include <cmath>
#include <numbers>

#include <skelgen/core/mesh.hpp>

namespace skelgen {

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
    Scalar area = 0;
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) area += face_area_vector(mesh, f).norm();
    return area;
}

/// Signed volume enclosed by the surface (positive for outward faces); meaningful for closed surfaces. O(faces).
template <typename Scalar>
[[nodiscard]] Scalar enclosed_volume(const TriangleMesh<Scalar>& mesh) {
    Scalar volume = 0;
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f)
        volume += face_area_vector(mesh, f).dot(mesh.vertices.row(mesh.faces(f, 0)).transpose());
    return volume / 3;
}

/// Area-weighted unit vertex normals, n x 3; zero rows for vertices without area. O(n + faces).
template <typename Scalar>
[[nodiscard]] Points<Scalar> vertex_normals(const TriangleMesh<Scalar>& mesh) {
    Points<Scalar> normals = Points<Scalar>::Zero(mesh.vertices.rows(), 3);
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
        const Vector3<Scalar> area = face_area_vector(mesh, f);
        for (int k = 0; k < 3; ++k) normals.row(mesh.faces(f, k)) += area.transpose();
    }
    for (Eigen::Index v = 0; v < normals.rows(); ++v) {
        const Scalar length = normals.row(v).norm();
        if (length > 0) normals.row(v) /= length;
    }
    return normals;
}

/// Generalized winding number of the surface around a point: 1 inside, 0 outside a closed outward surface, in between
/// near holes (Jacobson et al. 2013): the sum of the faces' solid angles (van Oosterom & Strackee 1983). O(faces).
template <typename Scalar>
[[nodiscard]] Scalar winding_number(const TriangleMesh<Scalar>& mesh, const Vector3<Scalar>& point) {
    Scalar angle = 0;
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
        const Vector3<Scalar> a = mesh.vertices.row(mesh.faces(f, 0)).transpose() - point;
        const Vector3<Scalar> b = mesh.vertices.row(mesh.faces(f, 1)).transpose() - point;
        const Vector3<Scalar> c = mesh.vertices.row(mesh.faces(f, 2)).transpose() - point;
        const Scalar la = a.norm(), lb = b.norm(), lc = c.norm();
        const Scalar denominator = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
        angle += std::atan2(a.dot(b.cross(c)), denominator);
    }
    return angle / (2 * std::numbers::pi_v<Scalar>);
}

} // namespace skelgen
