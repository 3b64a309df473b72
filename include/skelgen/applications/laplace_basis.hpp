#pragma once

#include <Eigen/Core>

#include <skelgen/core/mesh.hpp>
#include <skelgen/core/precision.hpp>

namespace skelgen::applications {

/// The smoothest functions on a surface: eigenfunctions of its Laplacian, orthonormal over the area. Double whatever
/// the mesh's scalar: they come out of a factorisation.
struct LaplaceBasis {
    Eigen::VectorX<core::Accumulator> values;    ///< k eigenvalues, ascending, the first 0; per area
    Eigen::MatrixX<core::Accumulator> functions; ///< n x k
    Eigen::VectorX<core::Accumulator> areas;     ///< n, of the vertices: a third of those of their faces
};

/// The first `count` eigenfunctions of the cotangent Laplacian with lumped masses. The mesh must be one manifold piece
/// with more vertices than twice `count`. \throws Error usage when it has fewer, internal when they are not found.
/// O(n^1.5 + n count^2).
template <typename Scalar>
[[nodiscard]] LaplaceBasis laplace_basis(const TriangleMesh<Scalar>& mesh, int count);

} // namespace skelgen::applications

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/applications/impl/laplace_basis.hpp>
#endif
