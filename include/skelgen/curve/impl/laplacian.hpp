#pragma once

#include <skelgen/core/geometry.hpp>
#include <skelgen/curve/laplacian.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace skelgen::curve {
namespace detail {

/// Cotangents of a triangle's angles from its squared edge lengths, entry k opposite edge k. Bounded by `largest`, also
/// for a triangle that has degenerated to a segment or a point.
inline Vector3<core::Accumulator> bounded_cotangents(const Vector3<core::Accumulator>& squared_lengths,
                                                     core::Accumulator double_area, core::Accumulator largest) {
    Vector3<core::Accumulator> cotangents;
    for (int k = 0; k < 3; ++k) {
        const core::Accumulator numerator = squared_lengths.sum() - 2 * squared_lengths[k];
        const core::Accumulator bound = 2 * double_area * largest;
        cotangents[k] = std::abs(numerator) < bound ? numerator / (2 * double_area) : std::copysign(largest, numerator);
    }
    return cotangents;
}

} // namespace detail

template <typename Scalar>
Eigen::SparseMatrix<core::Accumulator> cotangent_laplacian(const Points<Scalar>& vertices, const Triangles& faces,
                                                           double largest_cotangent) {
    using core::Accumulator;
    constexpr Accumulator least_weight = 1e-6;

    std::vector<Eigen::Triplet<Accumulator>> entries;
    entries.reserve(static_cast<std::size_t>(faces.rows()) * 12);
    for (Eigen::Index f = 0; f < faces.rows(); ++f) {
        Vector3<Accumulator> corner[3], squared_lengths;
        for (int k = 0; k < 3; ++k) corner[k] = core::point(vertices, faces(f, k)).template cast<Accumulator>();
        for (int k = 0; k < 3; ++k) squared_lengths[k] = (corner[(k + 2) % 3] - corner[(k + 1) % 3]).squaredNorm();
        const Accumulator double_area = (corner[1] - corner[0]).cross(corner[2] - corner[0]).norm();
        const Vector3<Accumulator> cotangents =
            detail::bounded_cotangents(squared_lengths, double_area, largest_cotangent);
        for (int k = 0; k < 3; ++k) {
            const int i = faces(f, (k + 1) % 3), j = faces(f, (k + 2) % 3);
            const Accumulator weight = cotangents[k];
            entries.emplace_back(i, j, weight);
            entries.emplace_back(j, i, weight);
        }
    }
    Eigen::SparseMatrix<Accumulator> laplacian(vertices.rows(), vertices.rows());
    for (Eigen::Index v = 0; v < vertices.rows(); ++v)
        entries.emplace_back(static_cast<int>(v), static_cast<int>(v), Accumulator(0));
    laplacian.setFromTriplets(entries.begin(), entries.end());

    for (int v = 0; v < laplacian.outerSize(); ++v) {
        Accumulator sum = 0;
        Accumulator* diagonal = nullptr;
        for (Eigen::SparseMatrix<Accumulator>::InnerIterator it(laplacian, v); it; ++it) {
            if (it.row() == v) {
                diagonal = &it.valueRef();
                continue;
            }
            it.valueRef() = std::clamp(it.value(), least_weight, largest_cotangent);
            sum += it.value();
        }
        *diagonal = -sum;
    }
    return laplacian;
}

} // namespace skelgen::curve
