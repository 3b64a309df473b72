#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/SparseCore>

#include <skelgen/core/mesh.hpp>

namespace skelgen {

namespace detail {

/// Cotangents of a triangle's angles from its squared edge lengths, entry k opposite edge k. Bounded by `largest`, also
/// for a triangle that has degenerated to a segment or a point.
inline Vector3<double> bounded_cotangents(const Vector3<double>& squared_lengths, double double_area, double largest) {
    Vector3<double> cotangents;
    for (int k = 0; k < 3; ++k) {
        const double numerator = squared_lengths.sum() - 2 * squared_lengths[k];
        const double bound = 2 * double_area * largest;
        cotangents[k] = std::abs(numerator) < bound ? numerator / (2 * double_area) : std::copysign(largest, numerator);
    }
    return cotangents;
}

} // namespace detail

/// Cotangent Laplacian, n x n: off-diagonal cot a + cot b (positive between neighbours of a well-shaped mesh), rows sum
/// to zero, symmetric, negative semi-definite (Au08 section 3; no mass matrix, no factor 1/2). Weights are clamped to
/// [1e-6, largest_cotangent] so that triangles that degenerate in the course of contraction neither blow up nor turn an
/// attraction into a repulsion. Every edge of `faces` has an entry, so the sparsity is the same for every embedding.
/// O(n).
template <typename Scalar>
[[nodiscard]] Eigen::SparseMatrix<double> cotangent_laplacian(const Points<Scalar>& vertices, const Triangles& faces,
                                                              double largest_cotangent = 1e4) {
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(static_cast<std::size_t>(faces.rows()) * 12);
    for (Eigen::Index f = 0; f < faces.rows(); ++f) {
        Vector3<double> corner[3], squared_lengths;
        for (int k = 0; k < 3; ++k) corner[k] = vertices.row(faces(f, k)).transpose().template cast<double>();
        for (int k = 0; k < 3; ++k) squared_lengths[k] = (corner[(k + 2) % 3] - corner[(k + 1) % 3]).squaredNorm();
        const double double_area = (corner[1] - corner[0]).cross(corner[2] - corner[0]).norm();
        const Vector3<double> cotangents = detail::bounded_cotangents(squared_lengths, double_area, largest_cotangent);
        for (int k = 0; k < 3; ++k) {
            const int i = faces(f, (k + 1) % 3), j = faces(f, (k + 2) % 3);
            const double weight = cotangents[k];
            entries.emplace_back(i, j, weight);
            entries.emplace_back(j, i, weight);
        }
    }
    Eigen::SparseMatrix<double> laplacian(vertices.rows(), vertices.rows());
    for (Eigen::Index v = 0; v < vertices.rows(); ++v)
        entries.emplace_back(static_cast<int>(v), static_cast<int>(v), 0.0);
    laplacian.setFromTriplets(entries.begin(), entries.end());

    for (int v = 0; v < laplacian.outerSize(); ++v) {
        double sum = 0;
        double* diagonal = nullptr;
        for (Eigen::SparseMatrix<double>::InnerIterator it(laplacian, v); it; ++it) {
            if (it.row() == v) {
                diagonal = &it.valueRef();
                continue;
            }
            it.valueRef() = std::clamp(it.value(), 1e-6, largest_cotangent);
            sum += it.value();
        }
        *diagonal = -sum;
    }
    return laplacian;
}

} // namespace skelgen
