#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include <Eigen/Eigenvalues>

#include <skelgen/core/error.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/mesh.hpp>

namespace skelgen {

/// A rotation, a uniform scale and a translation: canonical = rotation * (input - origin) / scale.
struct Similarity {
    Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
    Vector3<double> origin = Vector3<double>::Zero();
    double scale = 1;

    [[nodiscard]] Vector3<double> to_canonical(const Vector3<double>& p) const {
        return rotation * (p - origin) / scale;
    }
    [[nodiscard]] Vector3<double> to_input(const Vector3<double>& p) const {
        return rotation.transpose() * p * scale + origin;
    }
};

/// A mesh in the one position, size, order and precision in which the pipeline works.
struct CanonicalMesh {
    TriangleMesh<double> mesh;     ///< unit area, centred, principal axes along x, y, z
    Similarity similarity;         ///< from the input's coordinates
    std::vector<int> input_vertex; ///< per canonical vertex its index in the input
};

namespace detail {

struct SurfaceMoments {
    double area = 0;
    Vector3<double> centroid = Vector3<double>::Zero();
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

/// Exact first and second moments of the surface, independent of how it is triangulated.
inline SurfaceMoments surface_moments(const TriangleMesh<double>& mesh) {
    SurfaceMoments moments;
    const auto corner = [&](Eigen::Index f, int k) { return Vector3<double>(mesh.vertices.row(mesh.faces(f, k))); };
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
        const double area = face_area_vector(mesh, f).norm();
        moments.area += area;
        moments.centroid += area * (corner(f, 0) + corner(f, 1) + corner(f, 2)) / 3;
    }
    if (!(moments.area > 0)) return moments;
    moments.centroid /= moments.area;
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
        const double area = face_area_vector(mesh, f).norm();
        Vector3<double> sum = Vector3<double>::Zero();
        for (int k = 0; k < 3; ++k) {
            const Vector3<double> d = corner(f, k) - moments.centroid;
            moments.covariance += area / 12 * d * d.transpose();
            sum += d;
        }
        moments.covariance += area / 12 * sum * sum.transpose();
    }
    moments.covariance /= moments.area;
    return moments;
}

/// Third moment of the surface along a direction, over the faces' centres.
inline double skewness(const TriangleMesh<double>& mesh, const Vector3<double>& centroid, const Vector3<double>& axis) {
    double sum = 0;
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
        double along = 0;
        for (int c = 0; c < 3; ++c) along += axis.dot(mesh.vertices.row(mesh.faces(f, c)).transpose() - centroid);
        sum += face_area_vector(mesh, f).norm() * std::pow(along / 3, 3);
    }
    return sum;
}

/// Principal axes as the rows of a rotation, longest first. The senses of the two most skewed ones follow their third
/// moments; the remaining one, across which a mirror-symmetric body has none, completes the right-handed triple.
inline Eigen::Matrix3d principal_rotation(const TriangleMesh<double>& mesh, const SurfaceMoments& moments) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(moments.covariance);
    Eigen::Matrix3d rotation;
    Vector3<double> skew;
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

} // namespace detail

/// Brings a mesh into canonical form: moved to its centroid, turned to its principal axes, scaled to unit area,
/// vertices and faces in geometric order. A body turned, moved, scaled or with its vertices and faces shuffled has the
/// same canonical form up to rounding, which is what makes every later step indifferent to all of that. O(n log n).
/// \throws Error bad_input when the surface has no area.
template <typename Scalar>
[[nodiscard]] CanonicalMesh canonical_form(const TriangleMesh<Scalar>& mesh) {
    // Centring first keeps precision when the body stands a hundred body lengths from the origin.
    TriangleMesh<double> input{mesh.vertices.template cast<double>(), mesh.faces};
    const Vector3<double> offset = input.vertices.colwise().mean();
    input.vertices.rowwise() -= offset.transpose();
    const double extent = input.vertices.cwiseAbs().maxCoeff();
    if (!(extent > 0)) throw Error(ErrorCode::bad_input, "the surface has no extent; all its vertices coincide");
    input.vertices /= extent;

    const detail::SurfaceMoments moments = detail::surface_moments(input);
    if (!(moments.area > 1e-12)) throw Error(ErrorCode::bad_input, "the surface has no area; all faces are degenerate");

    CanonicalMesh out;
    out.similarity.rotation = detail::principal_rotation(input, moments);
    out.similarity.scale = extent * std::sqrt(moments.area);
    out.similarity.origin = offset + extent * moments.centroid;
    const Points<double> moved =
        ((input.vertices.rowwise() - moments.centroid.transpose()) * out.similarity.rotation.transpose()) /
        std::sqrt(moments.area);

    out.input_vertex.resize(static_cast<std::size_t>(moved.rows()));
    std::iota(out.input_vertex.begin(), out.input_vertex.end(), 0);
    // Along a direction askew to the axes, on which the two halves of a symmetric body do not tie.
    const Eigen::VectorXd rank = moved * Vector3<double>(1, 0.7548776662466927, 0.5698402909980532);
    std::sort(out.input_vertex.begin(), out.input_vertex.end(),
              [&](int a, int b) { return rank[a] != rank[b] ? rank[a] < rank[b] : a < b; });
    std::vector<int> canonical_index(out.input_vertex.size());
    out.mesh.vertices.resize(moved.rows(), 3);
    for (std::size_t i = 0; i < out.input_vertex.size(); ++i) {
        canonical_index[static_cast<std::size_t>(out.input_vertex[i])] = static_cast<int>(i);
        out.mesh.vertices.row(static_cast<Eigen::Index>(i)) = moved.row(out.input_vertex[i]);
    }

    std::vector<std::array<int, 3>> faces(static_cast<std::size_t>(mesh.faces.rows()));
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
        std::array<int, 3>& face = faces[static_cast<std::size_t>(f)];
        for (std::size_t k = 0; k < 3; ++k)
            face[k] = canonical_index[static_cast<std::size_t>(mesh.faces(f, static_cast<Eigen::Index>(k)))];
        std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
    }
    std::sort(faces.begin(), faces.end());
    out.mesh.faces.resize(mesh.faces.rows(), 3);
    for (std::size_t f = 0; f < faces.size(); ++f)
        for (Eigen::Index k = 0; k < 3; ++k)
            out.mesh.faces(static_cast<Eigen::Index>(f), k) = faces[f][static_cast<std::size_t>(k)];
    return out;
}

} // namespace skelgen
