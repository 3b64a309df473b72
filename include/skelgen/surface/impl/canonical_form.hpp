#pragma once

#include <skelgen/surface/canonical_form.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <Eigen/Eigenvalues>

#include <skelgen/core/error.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/precision.hpp>

namespace skelgen::surface {
namespace detail {

using core::Accumulator;

/// Sums over all faces, hence in the accumulator's precision.
struct SurfaceMoments {
    Accumulator area = 0;
    Vector3<Accumulator> centroid = Vector3<Accumulator>::Zero();
    Eigen::Matrix<Accumulator, 3, 3> covariance = Eigen::Matrix<Accumulator, 3, 3>::Zero();
};

template <typename Scalar>
Vector3<Accumulator> corner(const TriangleMesh<Scalar>& mesh, Eigen::Index f, int k) {
    return mesh.vertices.row(mesh.faces(f, k)).transpose().template cast<Accumulator>();
}

/// Exact first and second moments of the surface, independent of how it is triangulated.
template <typename Scalar>
SurfaceMoments surface_moments(const TriangleMesh<Scalar>& mesh) {
    SurfaceMoments moments;
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
        const Accumulator area = core::face_area_vector(mesh, f).norm();
        moments.area += area;
        moments.centroid += area * (corner(mesh, f, 0) + corner(mesh, f, 1) + corner(mesh, f, 2)) / 3;
    }
    if (!(moments.area > 0)) return moments;
    moments.centroid /= moments.area;
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
        const Accumulator area = core::face_area_vector(mesh, f).norm();
        Vector3<Accumulator> sum = Vector3<Accumulator>::Zero();
        for (int k = 0; k < 3; ++k) {
            const Vector3<Accumulator> d = corner(mesh, f, k) - moments.centroid;
            moments.covariance += area / 12 * d * d.transpose();
            sum += d;
        }
        moments.covariance += area / 12 * sum * sum.transpose();
    }
    moments.covariance /= moments.area;
    return moments;
}

/// Third moment of the surface along a direction, over the faces' centres.
template <typename Scalar>
Accumulator skewness(const TriangleMesh<Scalar>& mesh, const Vector3<Accumulator>& centroid,
                     const Vector3<Accumulator>& axis) {
    Accumulator sum = 0;
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
        Accumulator along = 0;
        for (int c = 0; c < 3; ++c) along += axis.dot(corner(mesh, f, c) - centroid);
        sum += core::face_area_vector(mesh, f).norm() * std::pow(along / 3, 3);
    }
    return sum;
}

/// Principal axes as the rows of a rotation, longest first. The senses of the two most skewed ones follow their third
/// moments; the remaining one, across which a mirror-symmetric body has none, completes the right-handed triple.
template <typename Scalar>
Eigen::Matrix<Accumulator, 3, 3> principal_rotation(const TriangleMesh<Scalar>& mesh, const SurfaceMoments& moments) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<Accumulator, 3, 3>> solver(moments.covariance);
    Eigen::Matrix<Accumulator, 3, 3> rotation;
    Vector3<Accumulator> skew;
    for (int k = 0; k < 3; ++k) {
        rotation.row(k) = solver.eigenvectors().col(2 - k).transpose();
        skew[k] = skewness(mesh, moments.centroid, rotation.row(k).transpose());
        if (skew[k] < 0) rotation.row(k) *= -1;
    }
    Eigen::Index least = 0;
    skew.cwiseAbs().minCoeff(&least);
    rotation.row(least) = rotation.row((least + 1) % 3).cross(rotation.row((least + 2) % 3));
    return rotation;
}

/// Vertices in the order of their height along a direction askew to the axes, on which the two halves of a symmetric
/// body do not tie. In the accumulator's precision: in float a hundred thousand heights would have many ties.
template <typename Scalar>
std::vector<int> geometric_order(const Points<Scalar>& vertices) {
    const Vector3<Accumulator> askew(1, 0.7548776662466927, 0.5698402909980532);
    const Eigen::Matrix<Accumulator, Eigen::Dynamic, 1> height = vertices.template cast<Accumulator>() * askew;
    std::vector<int> order(static_cast<std::size_t>(vertices.rows()));
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(),
              [&](int a, int b) { return height[a] != height[b] ? height[a] < height[b] : a < b; });
    return order;
}

/// Faces on renumbered vertices, each from its lowest one on, in ascending order.
inline Triangles sorted_faces(const Triangles& faces, const std::vector<int>& new_index) {
    std::vector<std::array<int, 3>> list(static_cast<std::size_t>(faces.rows()));
    for (Eigen::Index f = 0; f < faces.rows(); ++f) {
        std::array<int, 3>& face = list[static_cast<std::size_t>(f)];
        for (std::size_t k = 0; k < 3; ++k)
            face[k] = new_index[static_cast<std::size_t>(faces(f, static_cast<Eigen::Index>(k)))];
        std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
    }
    std::sort(list.begin(), list.end());
    Triangles out(faces.rows(), 3);
    for (std::size_t f = 0; f < list.size(); ++f)
        out.row(static_cast<Eigen::Index>(f)) << list[f][0], list[f][1], list[f][2];
    return out;
}

} // namespace detail

template <typename Scalar>
CanonicalMesh<Scalar> canonical_form(const TriangleMesh<Scalar>& mesh) {
    // Centring first keeps precision when the body stands a hundred body lengths from the origin.
    TriangleMesh<Scalar> input = mesh;
    const Vector3<Scalar> offset =
        mesh.vertices.template cast<core::Accumulator>().colwise().mean().transpose().template cast<Scalar>();
    input.vertices.rowwise() -= offset.transpose();
    const Scalar extent = input.vertices.cwiseAbs().maxCoeff();
    if (!(extent > 0)) throw Error(ErrorCode::bad_input, "the surface has no extent; all its vertices coincide");
    input.vertices /= extent;

    const detail::SurfaceMoments moments = detail::surface_moments(input);
    if (!(moments.area > core::rounding<Scalar>() * core::rounding<Scalar>()))
        throw Error(ErrorCode::bad_input, "the surface has no area; all faces are degenerate");
    const Vector3<Scalar> centroid = moments.centroid.template cast<Scalar>();
    const Scalar size = static_cast<Scalar>(std::sqrt(moments.area));

    CanonicalMesh<Scalar> out;
    out.similarity.rotation = detail::principal_rotation(input, moments).template cast<Scalar>();
    out.similarity.scale = extent * size;
    out.similarity.origin = offset + extent * centroid;
    const Points<Scalar> moved =
        ((input.vertices.rowwise() - centroid.transpose()) * out.similarity.rotation.transpose()) / size;

    out.input_vertex = detail::geometric_order(moved);
    std::vector<int> canonical_index(out.input_vertex.size());
    out.mesh.vertices.resize(moved.rows(), 3);
    for (std::size_t i = 0; i < out.input_vertex.size(); ++i) {
        canonical_index[static_cast<std::size_t>(out.input_vertex[i])] = static_cast<int>(i);
        out.mesh.vertices.row(static_cast<Eigen::Index>(i)) = moved.row(out.input_vertex[i]);
    }
    out.mesh.faces = detail::sorted_faces(mesh.faces, canonical_index);
    return out;
}

} // namespace skelgen::surface
