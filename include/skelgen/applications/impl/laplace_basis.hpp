#pragma once

#include <skelgen/applications/laplace_basis.hpp>

#include <cmath>
#include <limits>

#include <Eigen/SparseCholesky>
#include <Spectra/SymEigsShiftSolver.h>

#include <skelgen/applications/surface_laplacian.hpp>
#include <skelgen/core/error.hpp>
#include <skelgen/core/geometry.hpp>

namespace skelgen::applications {
namespace detail {

/// Solves with a shifted matrix: what Spectra asks of an operator. Cholesky's factors of a matrix that a negative shift
/// has made definite take a tenth of the time of the general ones that Spectra brings.
class ShiftedCholesky {
public:
    using Scalar = core::Accumulator; // Spectra's name

    explicit ShiftedCholesky(const Eigen::SparseMatrix<core::Accumulator>& matrix) : matrix_(matrix) {}
    [[nodiscard]] Eigen::Index rows() const { return matrix_.rows(); }
    [[nodiscard]] Eigen::Index cols() const { return matrix_.cols(); }
    void set_shift(core::Accumulator shift) {
        Eigen::SparseMatrix<core::Accumulator> shifted = matrix_;
        shifted.diagonal().array() -= shift;
        solver_.compute(shifted);
        if (solver_.info() != Eigen::Success)
            throw Error(ErrorCode::internal, "the Laplacian of the surface cannot be factorised");
    }
    void perform_op(const core::Accumulator* in, core::Accumulator* out) const {
        Eigen::Map<Eigen::VectorX<core::Accumulator>>(out, rows()) =
            solver_.solve(Eigen::Map<const Eigen::VectorX<core::Accumulator>>(in, rows()));
    }

private:
    Eigen::SparseMatrix<core::Accumulator> matrix_;
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<core::Accumulator>> solver_;
};

} // namespace detail

template <typename Scalar>
LaplaceBasis laplace_basis(const TriangleMesh<Scalar>& mesh, int count) {
    const Eigen::Index n = mesh.vertices.rows();
    if (count < 1 || 2 * count >= n)
        throw Error(ErrorCode::usage, "a basis of so many functions needs a surface with more vertices");
    LaplaceBasis basis;
    basis.areas = core::vertex_areas(mesh);
    // M^-1/2 L M^-1/2 has the same eigenvalues and is symmetric. A vertex without area would have an infinite one.
    const core::Accumulator least = basis.areas.sum() / static_cast<core::Accumulator>(n) * 1e-6;
    const Eigen::VectorX<core::Accumulator> scale = basis.areas.cwiseMax(least).cwiseSqrt().cwiseInverse();
    const Eigen::SparseMatrix<core::Accumulator> matrix =
        scale.asDiagonal() * surface_laplacian(mesh) * scale.asDiagonal();
    detail::ShiftedCholesky operation(matrix);
    const core::Accumulator shift = -1e-2 / basis.areas.sum(); // far below the second one, and away from the first, 0
    Spectra::SymEigsShiftSolver<detail::ShiftedCholesky> solver(operation, count, 2 * count, shift);
    solver.init();
    solver.compute(Spectra::SortRule::LargestMagn, 1000, 1e-8, Spectra::SortRule::SmallestAlge);
    if (solver.info() != Spectra::CompInfo::Successful)
        throw Error(ErrorCode::internal, "the smoothest functions on the surface were not found");
    basis.values = solver.eigenvalues();
    basis.functions = scale.asDiagonal() * solver.eigenvectors();
    return basis;
}

} // namespace skelgen::applications
