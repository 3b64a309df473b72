#pragma once

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

} // namespace skelgen::curve

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/curve/impl/laplacian.hpp>
#endif
