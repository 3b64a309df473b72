#pragma once

#include <skelgen/applications/part_shares.hpp>

#include <cstddef>

#include <Eigen/SparseCholesky>

#include <skelgen/applications/surface_laplacian.hpp>
#include <skelgen/core/error.hpp>
#include <skelgen/core/geometry.hpp>

namespace skelgen::applications {

template <typename Scalar>
Eigen::MatrixX<core::Accumulator> part_shares(const Body<Scalar>& body, const std::vector<int>& labels, int count,
                                              double length) {
    using Matrix = Eigen::SparseMatrix<core::Accumulator>;
    const Eigen::Index n = body.mesh.vertices.rows();
    const Eigen::VectorX<core::Accumulator> stay = core::vertex_areas(body.mesh) / (length * length);
    Matrix system = surface_laplacian(body.mesh);
    system.diagonal() += stay;
    const Eigen::SimplicialLDLT<Matrix> solver(system);
    if (solver.info() != Eigen::Success)
        throw Error(ErrorCode::bad_input, "the surface has no area to divide into parts; repair the mesh");
    Eigen::MatrixX<core::Accumulator> start = Eigen::MatrixX<core::Accumulator>::Zero(n, count);
    for (Eigen::Index v = 0; v < n; ++v) start(v, labels[static_cast<std::size_t>(v)]) = stay[v];
    return solver.solve(start);
}

} // namespace skelgen::applications
