#pragma once

#include <skelgen/surface/rounded.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include <skelgen/core/geometry.hpp>

namespace skelgen::surface {
namespace detail {

/// The middle of the cubic curve between two points that leaves each of them in the plane of its normal (VPBM01).
template <typename Scalar>
Vector3<Scalar> middle_of_arc(const Vector3<Scalar>& a, const Vector3<Scalar>& normal_a, const Vector3<Scalar>& b,
                              const Vector3<Scalar>& normal_b) {
    const Vector3<Scalar> way = b - a;
    return (a + b) / 2 - (way.dot(normal_a) * normal_a - way.dot(normal_b) * normal_b) / 8;
}

} // namespace detail

template <typename Scalar>
TriangleMesh<Scalar> rounded(const TriangleMesh<Scalar>& mesh) {
    const auto edge = [&](Eigen::Index f, int k) {
        const int a = mesh.faces(f, k), b = mesh.faces(f, (k + 1) % 3);
        return std::pair(std::min(a, b), std::max(a, b));
    };
    std::vector<std::pair<int, int>> edges;
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f)
        for (int k = 0; k < 3; ++k) edges.push_back(edge(f, k));
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());

    const Eigen::Index n = mesh.vertices.rows();
    const Points<Scalar> normals = core::vertex_normals(mesh);
    TriangleMesh<Scalar> out;
    out.vertices.resize(n + static_cast<Eigen::Index>(edges.size()), 3);
    out.vertices.topRows(n) = mesh.vertices;
    for (std::size_t e = 0; e < edges.size(); ++e) {
        const auto [a, b] = edges[e];
        core::set_point<Scalar>(out.vertices, n + static_cast<Eigen::Index>(e),
                                detail::middle_of_arc<Scalar>(core::point(mesh.vertices, a), core::point(normals, a),
                                                              core::point(mesh.vertices, b), core::point(normals, b)));
    }
    out.faces.resize(4 * mesh.faces.rows(), 3);
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
        std::array<int, 3> middle{};
        for (int k = 0; k < 3; ++k) {
            const auto place = std::lower_bound(edges.begin(), edges.end(), edge(f, k)) - edges.begin();
            middle[static_cast<std::size_t>(k)] = static_cast<int>(n + place);
        }
        out.faces.row(4 * f) << mesh.faces(f, 0), middle[0], middle[2];
        out.faces.row(4 * f + 1) << middle[0], mesh.faces(f, 1), middle[1];
        out.faces.row(4 * f + 2) << middle[2], middle[1], mesh.faces(f, 2);
        out.faces.row(4 * f + 3) << middle[0], middle[1], middle[2];
    }
    return out;
}

} // namespace skelgen::surface
