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

/// Per vertex of a closed surface how far it is below the mean of its neighbours, along its normal.
template <typename Scalar>
std::vector<Scalar> bulges_of_closed(const TriangleMesh<Scalar>& mesh) {
    struct Around { ///< a vertex: sums
        Vector3<Scalar> to_neighbours = Vector3<Scalar>::Zero(), normal = Vector3<Scalar>::Zero();
        int neighbours = 0;
    };
    std::vector<Around> around(static_cast<std::size_t>(mesh.vertices.rows()));
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
        const Vector3<Scalar> normal = core::face_area_vector(mesh, f);
        for (int k = 0; k < 3; ++k) {
            const int v = mesh.faces(f, k), next = mesh.faces(f, (k + 1) % 3), last = mesh.faces(f, (k + 2) % 3);
            const Vector3<Scalar> place = core::point(mesh.vertices, v);
            Around& here = around[static_cast<std::size_t>(v)];
            here.to_neighbours += core::point(mesh.vertices, next) - place;
            here.to_neighbours += core::point(mesh.vertices, last) - place;
            here.normal += normal;
            here.neighbours += 2;
        }
    }
    std::vector<Scalar> out(around.size(), Scalar(0));
    for (std::size_t v = 0; v < out.size(); ++v) {
        const auto& [to_neighbours, normal, neighbours] = around[v];
        const Scalar length = normal.norm() * static_cast<Scalar>(neighbours);
        if (length > 0) out[v] = to_neighbours.dot(normal) / length;
    }
    return out;
}

/// The same as `coherence`, of a closed surface, each edge of which two faces have: without a list of edges.
template <typename Scalar>
Scalar coherence_of_closed(const TriangleMesh<Scalar>& mesh) {
    const std::vector<Scalar> bulges = bulges_of_closed(mesh);
    core::Accumulator alike = 0, all = 0;
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
        const auto bulge = [&](int corner) { return bulges[static_cast<std::size_t>(mesh.faces(f, corner))]; };
        const Scalar a = bulge(0), b = bulge(1), c = bulge(2);
        alike += a * b + b * c + c * a;
        all += a * a + b * b + c * c;
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
bool is_without_noise(const TriangleMesh<Scalar>& closed, const DenoiseOptions& options) {
    validate(options);
    return detail::coherence_of_closed(closed) >= static_cast<Scalar>(options.least_coherence);
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
