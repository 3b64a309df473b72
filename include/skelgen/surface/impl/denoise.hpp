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

/// Calls with the ends of each edge of a list.
inline auto each_of(const Edges& edges) {
    return [&edges](const auto& visit) {
        for (const auto& [a, b] : edges) visit(a, b);
    };
}

/// The same with those of each face: on a closed surface each edge twice, which changes nothing that is averaged.
inline auto each_side_of(const Triangles& faces) {
    return [&faces](const auto& visit) {
        for (Eigen::Index f = 0; f < faces.rows(); ++f)
            for (int k = 0; k < 3; ++k) visit(faces(f, k), faces(f, (k + 1) % 3));
    };
}

/// From each vertex to the mean of its neighbours; n x 3.
template <typename Scalar, typename EachEdge>
Points<Scalar> to_neighbours(const Points<Scalar>& vertices, const EachEdge& each_edge) {
    Points<Scalar> sum = Points<Scalar>::Zero(vertices.rows(), 3);
    std::vector<int> count(static_cast<std::size_t>(vertices.rows()), 0);
    each_edge([&](int a, int b) {
        sum.row(a) += vertices.row(b);
        sum.row(b) += vertices.row(a);
        ++count[static_cast<std::size_t>(a)];
        ++count[static_cast<std::size_t>(b)];
    });
    for (Eigen::Index v = 0; v < vertices.rows(); ++v)
        if (const int n = count[static_cast<std::size_t>(v)]; n > 0)
            sum.row(v) = (sum.row(v) / static_cast<Scalar>(n) - vertices.row(v)).eval();
    return sum;
}

template <typename Scalar, typename EachEdge>
Scalar coherence(const TriangleMesh<Scalar>& mesh, const EachEdge& each_edge) {
    Points<Scalar> off, normals;
    core::in_parallel([&] { off = to_neighbours(mesh.vertices, each_edge); },
                      [&] { normals = core::vertex_normals(mesh); });
    const Eigen::Matrix<Scalar, Eigen::Dynamic, 1> bulge = off.cwiseProduct(normals).rowwise().sum();
    core::Accumulator alike = 0, all = 0;
    each_edge([&](int a, int b) {
        alike += bulge[a] * bulge[b];
        all += Scalar(0.5) * (bulge[a] * bulge[a] + bulge[b] * bulge[b]);
    });
    return all > 0 ? static_cast<Scalar>(alike / all) : Scalar(1);
}

/// One pass: there and back again.
template <typename Scalar>
Points<Scalar> smoothed_once(Points<Scalar> vertices, const Edges& edges, const DenoiseOptions& options) {
    for (const double step : {options.shrinking, options.growing})
        vertices += static_cast<Scalar>(step) * to_neighbours(vertices, each_of(edges));
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
    const detail::Edges edges = core::edges_of(mesh.faces);
    return detail::coherence(mesh, detail::each_of(edges));
}

template <typename Scalar>
bool is_without_noise(const TriangleMesh<Scalar>& closed, const DenoiseOptions& options) {
    validate(options);
    return detail::coherence(closed, detail::each_side_of(closed.faces)) >=
           static_cast<Scalar>(options.least_coherence);
}

template <typename Scalar>
DenoisedMesh<Scalar> remove_noise(TriangleMesh<Scalar> mesh, const DenoiseOptions& options) {
    validate(options);
    const detail::Edges edges = core::edges_of(mesh.faces);
    const auto least = static_cast<Scalar>(options.least_coherence),
               enough = static_cast<Scalar>(options.enough_coherence);
    DenoisedMesh<Scalar> out{std::move(mesh), 0};
    const auto coherence = [&] { return detail::coherence(out.mesh, detail::each_of(edges)); };
    if (coherence() >= least) return out;
    for (; out.passes < options.most_passes && coherence() < enough; ++out.passes)
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
