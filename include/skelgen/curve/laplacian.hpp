#pragma once

#include <array>
#include <vector>

#include <Eigen/SparseCore>

#include <skelgen/core/mesh.hpp>
#include <skelgen/core/precision.hpp>

namespace skelgen::curve {

/// Cotangent Laplacian, n x n: off-diagonal cot a + cot b (positive between neighbours of a well-shaped mesh), rows sum
/// to zero, symmetric, negative semi-definite (Au08 section 3; no mass matrix, no factor 1/2). Every edge of `faces`
/// has an entry, so the sparsity is the same for every embedding.
///
/// Triangles degenerate in the course of contraction; so that they neither blow up nor turn an attraction into a
/// repulsion, cotangents are clamped to [-largest_cotangent, largest_cotangent] and weights to [1e-6,
/// largest_cotangent]. Between equilateral triangles the weight is 1.15: the lower bound is a millionth of that, next
/// to no pull but still a positive one; the default upper bound is the cotangent of an angle of 0.006 degrees, which a
/// proxy's triangle has only once it has collapsed. Both are calibrated.
///
/// Double whatever the mesh's scalar: it goes into a factorisation, and the cotangents of a thin triangle are
/// differences of nearly equal numbers. O(n).
template <typename Scalar>
[[nodiscard]] Eigen::SparseMatrix<core::Accumulator>
cotangent_laplacian(const Points<Scalar>& vertices, const Triangles& faces, double largest_cotangent = 1e4);

/// The same for one embedding of the same faces after the other: which entries there are is found out once.
class CotangentLaplacian {
public:
    /// Of `vertices` vertices. O(n log n).
    CotangentLaplacian(Eigen::Index vertices, const Triangles& faces);

    /// Holds until the next one. O(n).
    template <typename Scalar>
    [[nodiscard]] const Eigen::SparseMatrix<core::Accumulator>& of(const Points<Scalar>& vertices,
                                                                   double largest_cotangent = 1e4);

private:
    Triangles faces_;
    Eigen::SparseMatrix<core::Accumulator> matrix_;
    std::vector<std::array<int, 6>> entries_; ///< of a face: at 2 k and 2 k + 1 those of the edge opposite corner k
};

} // namespace skelgen::curve

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/curve/impl/laplacian.hpp>
#endif
