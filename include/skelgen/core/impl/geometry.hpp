#pragma once

#include <skelgen/core/geometry.hpp>

#include <cmath>
#include <numbers>

namespace skelgen::core {

template <typename Scalar>
Points<Scalar> vertex_normals(const TriangleMesh<Scalar>& mesh) {
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

template <typename Scalar>
Scalar winding_number(const TriangleMesh<Scalar>& mesh, const Vector3<Scalar>& point) {
    Accumulator angle = 0;
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
        const Vector3<Scalar> a = mesh.vertices.row(mesh.faces(f, 0)).transpose() - point;
        const Vector3<Scalar> b = mesh.vertices.row(mesh.faces(f, 1)).transpose() - point;
        const Vector3<Scalar> c = mesh.vertices.row(mesh.faces(f, 2)).transpose() - point;
        const Scalar la = a.norm(), lb = b.norm(), lc = c.norm();
        const Scalar denominator = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
        angle += std::atan2(a.dot(b.cross(c)), denominator);
    }
    return static_cast<Scalar>(angle / (2 * std::numbers::pi_v<Accumulator>));
}

template <typename Scalar>
int nearest_vertex(const TriangleMesh<Scalar>& mesh, const Vector3<Scalar>& point) {
    Eigen::Index nearest = 0;
    (mesh.vertices.rowwise() - point.transpose()).rowwise().squaredNorm().minCoeff(&nearest);
    return static_cast<int>(nearest);
}

} // namespace skelgen::core
