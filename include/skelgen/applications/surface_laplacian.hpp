#pragma once

#include <Eigen/SparseCore>

#include <skelgen/core/mesh.hpp>
#include <skelgen/core/precision.hpp>
#include <skelgen/curve/laplacian.hpp>

namespace skelgen::applications {

/// The Laplacian of a surface that stays as it is, n x n: positive semi-definite, minus half of cot a + cot b beside
/// the diagonal, rows sum to zero. Triangles with an angle below one degree count as if they had one of that. O(n).
template <typename Scalar>
[[nodiscard]] Eigen::SparseMatrix<core::Accumulator> surface_laplacian(const TriangleMesh<Scalar>& mesh) {
    constexpr double cotangent_of_one_degree = 57;
    return -0.5 * curve::cotangent_laplacian(mesh.vertices, mesh.faces, cotangent_of_one_degree);
}

} // namespace skelgen::applications
