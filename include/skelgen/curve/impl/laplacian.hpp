#pragma once

#include <skelgen/core/geometry.hpp>
#include <skelgen/curve/laplacian.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <skelgen/core/header_only.hpp>

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

SKELGEN_INLINE CotangentLaplacian::CotangentLaplacian(Eigen::Index vertices, const Triangles& faces)
    : faces_(faces), matrix_(vertices, vertices), entries_(static_cast<std::size_t>(faces.rows())) {
    std::vector<Eigen::Triplet<core::Accumulator>> all;
    all.reserve(static_cast<std::size_t>(faces.size()) * 2 + static_cast<std::size_t>(vertices));
    const auto edge = [&](Eigen::Index f, int k) { return std::array{faces(f, (k + 1) % 3), faces(f, (k + 2) % 3)}; };
    for (Eigen::Index f = 0; f < faces.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            const auto [i, j] = edge(f, k);
            all.emplace_back(i, j, 0);
            all.emplace_back(j, i, 0);
        }
    for (Eigen::Index v = 0; v < vertices; ++v) all.emplace_back(static_cast<int>(v), static_cast<int>(v), 0);
    matrix_.setFromTriplets(all.begin(), all.end());
    const auto place = [&](int row, int column) {
        const int* begin = matrix_.innerIndexPtr() + matrix_.outerIndexPtr()[column];
        const int* end = matrix_.innerIndexPtr() + matrix_.outerIndexPtr()[column + 1];
        return static_cast<int>(std::lower_bound(begin, end, row) - matrix_.innerIndexPtr());
    };
    for (std::size_t f = 0; f < entries_.size(); ++f)
        for (std::size_t k = 0; k < 3; ++k) {
            const auto [i, j] = edge(static_cast<Eigen::Index>(f), static_cast<int>(k));
            entries_[f][2 * k] = place(i, j);
            entries_[f][2 * k + 1] = place(j, i);
        }
}

template <typename Scalar>
const Eigen::SparseMatrix<core::Accumulator>& CotangentLaplacian::of(const Points<Scalar>& vertices,
                                                                     double largest_cotangent) {
    using core::Accumulator;
    constexpr Accumulator least_weight = 1e-6;

    Accumulator* values = matrix_.valuePtr();
    std::fill(values, values + matrix_.nonZeros(), Accumulator(0));
    for (Eigen::Index f = 0; f < faces_.rows(); ++f) {
        Vector3<Accumulator> corner[3], squared_lengths;
        for (int k = 0; k < 3; ++k) corner[k] = core::point(vertices, faces_(f, k)).template cast<Accumulator>();
        for (int k = 0; k < 3; ++k) squared_lengths[k] = (corner[(k + 2) % 3] - corner[(k + 1) % 3]).squaredNorm();
        const Accumulator double_area = (corner[1] - corner[0]).cross(corner[2] - corner[0]).norm();
        const Vector3<Accumulator> cotangents =
            detail::bounded_cotangents(squared_lengths, double_area, largest_cotangent);
        const std::array<int, 6>& entries = entries_[static_cast<std::size_t>(f)];
        for (std::size_t k = 0; k < 3; ++k) {
            values[entries[2 * k]] += cotangents[static_cast<Eigen::Index>(k)];
            values[entries[2 * k + 1]] += cotangents[static_cast<Eigen::Index>(k)];
        }
    }
    for (int v = 0; v < matrix_.outerSize(); ++v) {
        Accumulator sum = 0;
        Accumulator* diagonal = nullptr;
        for (Eigen::SparseMatrix<Accumulator>::InnerIterator it(matrix_, v); it; ++it) {
            if (it.row() == v) {
                diagonal = &it.valueRef();
                continue;
            }
            it.valueRef() = std::clamp(it.value(), least_weight, largest_cotangent);
            sum += it.value();
        }
        *diagonal = -sum;
    }
    return matrix_;
}

template <typename Scalar>
Eigen::SparseMatrix<core::Accumulator> cotangent_laplacian(const Points<Scalar>& vertices, const Triangles& faces,
                                                           double largest_cotangent) {
    return CotangentLaplacian(vertices.rows(), faces).of(vertices, largest_cotangent);
}

} // namespace skelgen::curve
