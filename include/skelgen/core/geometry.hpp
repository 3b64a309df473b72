#pragma once

#include <algorithm>

#include <skelgen/core/mesh.hpp>
#include <skelgen/core/precision.hpp>

namespace skelgen::core {

/// Point `i` of a list. What is computed with points compiles much faster than the same with rows of matrices.
template <typename Scalar>
[[nodiscard]] Vector3<Scalar> point(const Points<Scalar>& points, Eigen::Index i) {
    return {points(i, 0), points(i, 1), points(i, 2)};
}

/// Makes `p` point `i` of a list.
template <typename Scalar>
void set_point(Points<Scalar>& points, Eigen::Index i, const Vector3<Scalar>& p) {
    for (int k = 0; k < 3; ++k) points(i, k) = p[k];
}

/// Where a segment comes nearest to a place.
template <typename Scalar>
struct NearestOnSegment {
    Scalar distance = 0; ///< from the place to there
    Scalar along = 0;    ///< 0 at the segment's first end, 1 at its second; 0 where both are the same
};

/// Where a parabola through values at -1, 0 and 1 is least, at most half a step from the middle; 0 where it opens
/// downwards.
template <typename Scalar>
[[nodiscard]] Scalar least_of_parabola(Scalar before, Scalar here, Scalar after) {
    const Scalar curvature = before - 2 * here + after, most = Scalar(0.5);
    return curvature > 0 ? std::clamp(Scalar(0.5) * (before - after) / curvature, -most, most) : Scalar(0);
}

/// Where the segment from `a` to `b` comes nearest to a place, in the plane or in space.
template <typename Scalar, int Dimensions>
[[nodiscard]] NearestOnSegment<Scalar> nearest_on_segment(const Eigen::Matrix<Scalar, Dimensions, 1>& place,
                                                          const Eigen::Matrix<Scalar, Dimensions, 1>& a,
                                                          const Eigen::Matrix<Scalar, Dimensions, 1>& b) {
    const Eigen::Matrix<Scalar, Dimensions, 1> ab = b - a;
    const Scalar length2 = ab.squaredNorm();
    const Scalar along = length2 > 0 ? std::clamp((place - a).dot(ab) / length2, Scalar(0), Scalar(1)) : Scalar(0);
    return {(a + along * ab - place).norm(), along};
}

/// Adds `weight` times the outer product of `d` with itself to a matrix of second moments.
template <typename Scalar>
void add_outer_product(Eigen::Matrix<Scalar, 3, 3>& moments, Scalar weight, const Vector3<Scalar>& d) {
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k) moments(i, k) += weight * d[i] * d[k];
}

/// Area vector of triangle `f`: normal times area, outward for counter-clockwise faces.
template <typename Scalar>
[[nodiscard]] inline Vector3<Scalar> face_area_vector(const TriangleMesh<Scalar>& mesh, Eigen::Index f) {
    const Vector3<Scalar> a = point(mesh.vertices, mesh.faces(f, 0));
    const Vector3<Scalar> b = point(mesh.vertices, mesh.faces(f, 1));
    const Vector3<Scalar> c = point(mesh.vertices, mesh.faces(f, 2));
    return Scalar(0.5) * (b - a).cross(c - a);
}

/// Total area of the surface. O(faces).
template <typename Scalar>
[[nodiscard]] Scalar surface_area(const TriangleMesh<Scalar>& mesh) {
    Accumulator area = 0;
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) area += face_area_vector(mesh, f).norm();
    return static_cast<Scalar>(area);
}

/// Of each vertex a third of the areas of its faces, n. O(n + faces).
template <typename Scalar>
[[nodiscard]] Eigen::VectorX<Accumulator> vertex_areas(const TriangleMesh<Scalar>& mesh) {
    Eigen::VectorX<Accumulator> areas = Eigen::VectorX<Accumulator>::Zero(mesh.vertices.rows());
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f)
        for (int k = 0; k < 3; ++k)
            areas[mesh.faces(f, k)] += static_cast<Accumulator>(face_area_vector(mesh, f).norm()) / 3;
    return areas;
}

/// Signed volume enclosed by the surface (positive for outward faces); meaningful for closed surfaces. O(faces).
template <typename Scalar>
[[nodiscard]] Scalar enclosed_volume(const TriangleMesh<Scalar>& mesh) {
    Accumulator volume = 0;
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f)
        volume += face_area_vector(mesh, f).dot(point(mesh.vertices, mesh.faces(f, 0)));
    return static_cast<Scalar>(volume / 3);
}

/// Area-weighted unit vertex normals, n x 3; zero rows for vertices without area. O(n + faces).
template <typename Scalar>
[[nodiscard]] Points<Scalar> vertex_normals(const TriangleMesh<Scalar>& mesh);

/// Generalized winding number of the surface around a point: 1 inside, 0 outside a closed outward surface, in between
/// near holes (JKS13): the sum of the faces' solid angles (OS83). O(faces).
template <typename Scalar>
[[nodiscard]] Scalar winding_number(const TriangleMesh<Scalar>& mesh, const Vector3<Scalar>& place);

/// Diagonal of the bounding box of some points; there must be one. O(n).
template <typename Scalar>
[[nodiscard]] Scalar bounding_diagonal(const Points<Scalar>& points) {
    return (points.colwise().maxCoeff() - points.colwise().minCoeff()).norm();
}

/// Index of the point nearest to a place, the first of equals; there must be one. O(n).
template <typename Scalar>
[[nodiscard]] int nearest_point(const Points<Scalar>& points, const Vector3<Scalar>& place);

/// Vertex of the mesh nearest to a place, the first of equals; the mesh must have one. O(n).
template <typename Scalar>
[[nodiscard]] int nearest_vertex(const TriangleMesh<Scalar>& mesh, const Vector3<Scalar>& place);

} // namespace skelgen::core

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/core/impl/geometry.hpp>
#endif
