#pragma once

#include <skelgen/applications/part_shares.hpp>

#include <cstddef>

#include <Eigen/SparseCholesky>

#include <skelgen/core/error.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/curve/laplacian.hpp>

namespace skelgen::applications {

template <typename Scalar>
Eigen::VectorX<core::Accumulator> vertex_areas(const TriangleMesh<Scalar>& mesh) {
    Eigen::VectorX<core::Accumulator> areas = Eigen::VectorX<core::Accumulator>::Zero(mesh.vertices.rows());
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f)
        for (int k = 0; k < 3; ++k)
            areas[mesh.faces(f, k)] += static_cast<core::Accumulator>(core::face_area_vector(mesh, f).norm()) / 3;
    return areas;
}

template <typename Scalar>
Eigen::MatrixX<core::Accumulator> part_shares(const Body<Scalar>& body, const std::vector<int>& labels, int count,
                                              double length) {
    using Matrix = Eigen::SparseMatrix<core::Accumulator>;
    constexpr double sharpest = 50; // cotangent of an angle of one degree: thinner triangles are as good as this
    const Eigen::Index n = body.mesh.vertices.rows();
    const Eigen::VectorX<core::Accumulator> stay = vertex_areas(body.mesh) / (length * length);
    Matrix system = -0.5 * curve::cotangent_laplacian(body.mesh.vertices, body.mesh.faces, sharpest); // no factor 1/2
    system.diagonal() += stay;
    const Eigen::SimplicialLDLT<Matrix> solver(system);
    if (solver.info() != Eigen::Success)
        throw Error(ErrorCode::bad_input, "the surface has no area to divide into parts; repair the mesh");
    Eigen::MatrixX<core::Accumulator> start = Eigen::MatrixX<core::Accumulator>::Zero(n, count);
    for (Eigen::Index v = 0; v < n; ++v) start(v, labels[static_cast<std::size_t>(v)]) = stay[v];
    return solver.solve(start);
}

} // namespace skelgen::applications
