#pragma once

#include <skelgen/curve/contraction.hpp>

#include <algorithm>
#include <cmath>

#include <Eigen/SparseCholesky>

#include <skelgen/core/error.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/header_only.hpp>
#include <skelgen/core/options.hpp>
#include <skelgen/core/precision.hpp>
#include <skelgen/curve/laplacian.hpp>

namespace skelgen::curve {
namespace detail {

using Weights = Eigen::Matrix<core::Accumulator, Eigen::Dynamic, 1>;

/// Sum of the areas of the faces around each vertex, n.
inline Weights one_ring_areas(const TriangleMesh<core::Accumulator>& mesh) {
    Weights areas = Weights::Zero(mesh.vertices.rows());
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
        const core::Accumulator area = core::face_area_vector(mesh, f).norm();
        for (int k = 0; k < 3; ++k) areas[mesh.faces(f, k)] += area;
    }
    return areas;
}

/// W_H^2 of each vertex once its one-ring has shrunk from `initial` to `now`; it holds back what has contracted
/// already. Below rounding, an area no longer tells how far that is.
inline Weights attraction_weights(const Weights& initial, const Weights& now, double first_weight) {
    Weights weights(initial.size());
    for (Eigen::Index v = 0; v < initial.size(); ++v) {
        const core::Accumulator least = core::rounding<core::Accumulator>() * initial[v];
        const core::Accumulator shrinkage = initial[v] > 0 ? initial[v] / std::max(now[v], least) : 1;
        weights[v] = first_weight * std::sqrt(shrinkage);
    }
    return weights;
}

/// -w_L L + (1 + w_M) W_H^2, n x n, of a Laplacian L.
inline Eigen::SparseMatrix<core::Accumulator> contraction_system(Eigen::SparseMatrix<core::Accumulator> laplacian,
                                                                 double laplacian_weight, const Weights& attraction,
                                                                 double medial_weight) {
    for (Eigen::Index i = 0; i < laplacian.nonZeros(); ++i) laplacian.valuePtr()[i] *= -laplacian_weight;
    for (int v = 0; v < laplacian.rows(); ++v) laplacian.coeffRef(v, v) += (1 + medial_weight) * attraction[v];
    return laplacian;
}

/// W_H^2 (V + w_M P), n x 3: what the vertices V are held to, together with the centres P of their balls.
template <typename Scalar>
Points<core::Accumulator> attractors(const Points<core::Accumulator>& vertices, const Points<Scalar>& centres,
                                     const Weights& attraction, double medial_weight) {
    Points<core::Accumulator> out(vertices.rows(), 3);
    for (Eigen::Index v = 0; v < vertices.rows(); ++v)
        for (int k = 0; k < 3; ++k)
            out(v, k) =
                attraction[v] * (vertices(v, k) + medial_weight * static_cast<core::Accumulator>(centres(v, k)));
    return out;
}

} // namespace detail

SKELGEN_INLINE void validate(const ContractionOptions& options) {
    core::require_in_range("contraction.laplacian_weight", options.laplacian_weight, 1e-6, 1e6);
    core::require_in_range("contraction.laplacian_growth", options.laplacian_growth, 1.0, 10.0);
    core::require_in_range("contraction.attraction_weight", options.attraction_weight, 1e-6, 1e6);
    core::require_in_range("contraction.medial_weight", options.medial_weight, 0.0, 1e6);
    core::require_in_range("contraction.largest_medial_radius", options.largest_medial_radius, 1e-3, 10.0);
    core::require_in_range("contraction.volume_ratio", options.volume_ratio, 0.0, 1.0);
    core::require_in_range("contraction.least_progress", options.least_progress, 0.0, 1.0);
    core::require_in_range("contraction.iterations", options.iterations, 1, 100);
}

template <typename Scalar>
MedialBalls<Scalar> contraction_balls(const TriangleMesh<Scalar>& mesh, const ContractionOptions& options) {
    return medial_balls(mesh, static_cast<Scalar>(options.largest_medial_radius) * std::sqrt(core::surface_area(mesh)));
}

template <typename Scalar>
Contraction<Scalar> contract(const TriangleMesh<Scalar>& mesh, const MedialBalls<Scalar>& balls,
                             const ContractionOptions& options) {
    validate(options);
    // The system is double whatever the mesh: weights, factor, and the vertices that it is solved for again and again.
    // Cotangents of collapsing triangles are up to thousands of times the attraction, which in float would be lost in
    // them; and vertices rounded to float between the iterations end so far off that surgery collapses other edges.
    using core::Accumulator;
    using System = Eigen::SparseMatrix<Accumulator>;

    TriangleMesh<Accumulator> contracted{mesh.vertices.template cast<Accumulator>(), mesh.faces};
    const detail::Weights initial_areas = detail::one_ring_areas(contracted);
    const Accumulator initial_volume = std::abs(core::enclosed_volume(contracted));
    const auto least_ratio = static_cast<Scalar>(options.volume_ratio);
    const auto most_remaining = static_cast<Scalar>(1 - options.least_progress);

    Contraction<Scalar> out;
    double laplacian_weight = options.laplacian_weight;
    detail::Weights attraction = detail::Weights::Constant(mesh.vertices.rows(), options.attraction_weight);
    CotangentLaplacian laplacian(mesh.vertices.rows(), mesh.faces);
    Eigen::SimplicialLLT<System> solver;
    while (out.iterations < options.iterations && !out.converged) {
        const System system = detail::contraction_system(laplacian.of(contracted.vertices), laplacian_weight,
                                                         attraction, options.medial_weight);
        if (out.iterations == 0) solver.analyzePattern(system);
        solver.factorize(system);
        if (solver.info() == Eigen::Success)
            contracted.vertices =
                solver.solve(detail::attractors(contracted.vertices, balls.centres, attraction, options.medial_weight));
        if (solver.info() != Eigen::Success || !contracted.vertices.allFinite())
            throw Error(ErrorCode::internal, "the contraction's system could not be solved");

        // A surface that encloses nothing has no volume to lose, and no moment to stop at.
        if (initial_volume > 0) {
            const auto ratio = static_cast<Scalar>(std::abs(core::enclosed_volume(contracted)) / initial_volume);
            out.converged = ratio < least_ratio || ratio > most_remaining * out.volume_ratio;
            out.volume_ratio = std::min(ratio, out.volume_ratio);
        }
        ++out.iterations;
        laplacian_weight *= options.laplacian_growth;
        attraction =
            detail::attraction_weights(initial_areas, detail::one_ring_areas(contracted), options.attraction_weight);
    }
    out.vertices = contracted.vertices.template cast<Scalar>();
    return out;
}

template <typename Scalar>
Contraction<Scalar> contract(const TriangleMesh<Scalar>& mesh, const ContractionOptions& options) {
    validate(options);
    return contract(mesh, contraction_balls(mesh, options), options);
}

} // namespace skelgen::curve
