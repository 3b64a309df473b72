#pragma once

#include <skelgen/surface/denoise.hpp>

#include <array>
#include <utility>
#include <vector>

#include <skelgen/core/adjacency.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/header_only.hpp>
#include <skelgen/core/options.hpp>
#include <skelgen/core/parallel.hpp>
#include <skelgen/core/precision.hpp>

namespace skelgen::surface {
namespace detail {

using Edges = std::vector<std::array<int, 2>>;

/// From each vertex to the mean of its neighbours; n x 3.
template <typename Scalar>
Points<Scalar> to_neighbours(const Points<Scalar>& vertices, const Edges& edges) {
    Points<Scalar> sum = Points<Scalar>::Zero(vertices.rows(), 3);
    std::vector<int> count(static_cast<std::size_t>(vertices.rows()), 0);
    for (const auto& [a, b] : edges) {
        sum.row(a) += vertices.row(b);
        sum.row(b) += vertices.row(a);
        ++count[static_cast<std::size_t>(a)];
        ++count[static_cast<std::size_t>(b)];
    }
    for (Eigen::Index v = 0; v < vertices.rows(); ++v)
        if (const int n = count[static_cast<std::size_t>(v)]; n > 0)
            sum.row(v) = (sum.row(v) / static_cast<Scalar>(n) - vertices.row(v)).eval();
    return sum;
}

template <typename Scalar>
Scalar coherence(const TriangleMesh<Scalar>& mesh, const Edges& edges) {
    Points<Scalar> off, normals;
    core::in_parallel([&] { off = to_neighbours(mesh.vertices, edges); },
                      [&] { normals = core::vertex_normals(mesh); });
    const Eigen::Matrix<Scalar, Eigen::Dynamic, 1> bulge = off.cwiseProduct(normals).rowwise().sum();
    core::Accumulator alike = 0, all = 0;
    for (const auto& [a, b] : edges) {
        alike += bulge[a] * bulge[b];
        all += Scalar(0.5) * (bulge[a] * bulge[a] + bulge[b] * bulge[b]);
    }
    return all > 0 ? static_cast<Scalar>(alike / all) : Scalar(1);
}

/// One pass: there and back again.
template <typename Scalar>
Points<Scalar> smoothed_once(Points<Scalar> vertices, const Edges& edges, const DenoiseOptions& options) {
    for (const double step : {options.shrinking, options.growing})
        vertices += static_cast<Scalar>(step) * to_neighbours(vertices, edges);
    return vertices;
}

} // namespace detail

SKELGEN_INLINE void validate(const DenoiseOptions& options) {
    core::require_in_range("denoise.least_coherence", options.least_coherence, -1.0, 1.0);
    core::require_in_range("denoise.enough_coherence", options.enough_coherence, -1.0, 1.0);
    core::require_in_range("denoise.most_passes", options.most_passes, 0, 1000);
    core::require_in_range("denoise.shrinking", options.shrinking, 0.0, 1.0);
    core::require_in_range("denoise.growing", options.growing, -2.0, 0.0);
}

template <typename Scalar>
Scalar bulge_coherence(const TriangleMesh<Scalar>& mesh) {
    return detail::coherence(mesh, core::edges_of(mesh.faces));
}

template <typename Scalar>
DenoisedMesh<Scalar> remove_noise(TriangleMesh<Scalar> mesh, const DenoiseOptions& options) {
    validate(options);
    const detail::Edges edges = core::edges_of(mesh.faces);
    const auto least = static_cast<Scalar>(options.least_coherence),
               enough = static_cast<Scalar>(options.enough_coherence);
    DenoisedMesh<Scalar> out{std::move(mesh), 0};
    if (detail::coherence(out.mesh, edges) >= least) return out;
    for (; out.passes < options.most_passes && detail::coherence(out.mesh, edges) < enough; ++out.passes)
        out.mesh.vertices = detail::smoothed_once(std::move(out.mesh.vertices), edges, options);
    return out;
}

template <typename Scalar>
TriangleMesh<Scalar> smoothed(TriangleMesh<Scalar> mesh, int passes, const DenoiseOptions& options) {
    validate(options);
    const detail::Edges edges = core::edges_of(mesh.faces);
    for (int pass = 0; pass < passes; ++pass)
        mesh.vertices = detail::smoothed_once(std::move(mesh.vertices), edges, options);
    return mesh;
}

} // namespace skelgen::surface
