#include <skelgen/curve/contraction.hpp>

#include <cmath>

#include <Eigen/SparseCholesky>

#include <skelgen/core/error.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/curve/laplacian.hpp>
#include <skelgen/curve/medial_balls.hpp>

namespace skelgen {
namespace {

/// Sum of the areas of the faces around each vertex.
Eigen::VectorXd one_ring_areas(const Points<double>& vertices, const Triangles& faces) {
    Eigen::VectorXd areas = Eigen::VectorXd::Zero(vertices.rows());
    const TriangleMesh<double> mesh{vertices, faces};
    for (Eigen::Index f = 0; f < faces.rows(); ++f) {
        const double area = face_area_vector(mesh, f).norm();
        for (int k = 0; k < 3; ++k) areas[faces(f, k)] += area;
    }
    return areas;
}

} // namespace

Contraction contract(const TriangleMesh<double>& mesh, const ContractionOptions& options) {
    const Eigen::VectorXd initial_areas = one_ring_areas(mesh.vertices, mesh.faces);
    const double initial_volume = std::abs(enclosed_volume(mesh));
    const MedialBalls balls = medial_balls(mesh, options.largest_medial_radius * std::sqrt(surface_area(mesh)));

    Contraction out;
    out.vertices = mesh.vertices;
    double laplacian_weight = options.laplacian_weight;
    Eigen::VectorXd attraction = Eigen::VectorXd::Constant(mesh.vertices.rows(), options.attraction_weight);
    Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> solver;
    while (out.iterations < options.iterations && !out.converged) {
        Eigen::SparseMatrix<double> system = -laplacian_weight * cotangent_laplacian(out.vertices, mesh.faces);
        system.diagonal() += (1 + options.medial_weight) * attraction;
        if (out.iterations == 0) solver.analyzePattern(system);
        solver.factorize(system);
        if (solver.info() != Eigen::Success)
            throw Error(ErrorCode::internal, "the contraction's system could not be factorised");
        const Points<double> held = out.vertices + options.medial_weight * balls.centres;
        out.vertices = solver.solve((attraction.asDiagonal() * held).eval());

        const double ratio = std::abs(enclosed_volume(TriangleMesh<double>{out.vertices, mesh.faces})) / initial_volume;
        out.converged = ratio < options.volume_ratio || ratio > (1 - options.least_progress) * out.volume_ratio;
        out.volume_ratio = std::min(ratio, out.volume_ratio);
        ++out.iterations;
        laplacian_weight *= options.laplacian_growth;
        const Eigen::VectorXd areas = one_ring_areas(out.vertices, mesh.faces);
        attraction = options.attraction_weight *
                     (initial_areas.array() / areas.array().max(1e-9 * initial_areas.array())).sqrt();
    }
    return out;
}

} // namespace skelgen
