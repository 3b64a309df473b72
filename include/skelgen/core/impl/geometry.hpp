#pragma once

#include <skelgen/core/geometry.hpp>

#include <cmath>
#include <limits>
#include <numbers>

namespace skelgen::core {

template <typename Scalar>
Points<Scalar> vertex_normals(const TriangleMesh<Scalar>& mesh) {
    Points<Scalar> normals = Points<Scalar>::Zero(mesh.vertices.rows(), 3);
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
        const Vector3<Scalar> area = face_area_vector(mesh, f);
        for (int k = 0; k < 3; ++k)
            set_point<Scalar>(normals, mesh.faces(f, k), point(normals, mesh.faces(f, k)) + area);
    }
    for (Eigen::Index v = 0; v < normals.rows(); ++v) {
        const Scalar length = point(normals, v).norm();
        if (length > 0) set_point<Scalar>(normals, v, point(normals, v) / length);
    }
    return normals;
}

template <typename Scalar>
Scalar winding_number(const TriangleMesh<Scalar>& mesh, const Vector3<Scalar>& place) {
    Accumulator angle = 0;
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
        const Vector3<Scalar> a = point(mesh.vertices, mesh.faces(f, 0)) - place;
        const Vector3<Scalar> b = point(mesh.vertices, mesh.faces(f, 1)) - place;
        const Vector3<Scalar> c = point(mesh.vertices, mesh.faces(f, 2)) - place;
        const Scalar la = a.norm(), lb = b.norm(), lc = c.norm();
        const Scalar denominator = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
        angle += std::atan2(a.dot(b.cross(c)), denominator);
    }
    return static_cast<Scalar>(angle / (2 * std::numbers::pi_v<Accumulator>));
}

template <typename Scalar>
int nearest_point(const Points<Scalar>& points, const Vector3<Scalar>& place) {
    int nearest = 0;
    Scalar least = std::numeric_limits<Scalar>::infinity();
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
        const Scalar distance = (point(points, i) - place).squaredNorm();
        if (!(distance < least)) continue;
        least = distance;
        nearest = static_cast<int>(i);
    }
    return nearest;
}

template <typename Scalar>
int nearest_vertex(const TriangleMesh<Scalar>& mesh, const Vector3<Scalar>& place) {
    return nearest_point(mesh.vertices, place);
}

} // namespace skelgen::core
