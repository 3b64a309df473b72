#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCholesky>

#include <skelgen/applications/surface_laplacian.hpp>
#include <skelgen/core/error.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/core/precision.hpp>
#include <skelgen/surface/body.hpp>

namespace skelgen::applications {

/// How much of each label is at each vertex, n x `count`, rows summing to 1: by where random walks over a length of
/// about `length` that start there end (Gra05): (L + A / length^2) x = A / length^2 p for each label's indicator p.
/// `labels` has n entries from 0 to `count` - 1. \throws Error bad_input when the surface has no area. O(n^1.5 + n
/// count).
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
