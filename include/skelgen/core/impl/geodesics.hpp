#pragma once

#include <skelgen/core/geodesics.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include <skelgen/core/geometry.hpp>

namespace skelgen::core {
namespace detail {

/// Distance between the far corners c and d of two faces that share the edge a b, of that length, unfolded into one
/// plane; infinite when the straight line between them would leave the two faces.
template <typename Scalar>
Scalar unfolded_distance(const Vector3<Scalar>& a, const Vector3<Scalar>& b, Scalar length, const Vector3<Scalar>& c,
                         const Vector3<Scalar>& d) {
    const Vector3<Scalar> axis = length > 0 ? Vector3<Scalar>((b - a) / length) : Vector3<Scalar>(b - a);
    const Scalar cx = (c - a).dot(axis), dx = (d - a).dot(axis);
    const Scalar cy = ((c - a) - cx * axis).norm(), dy = ((d - a) - dx * axis).norm();
    const Scalar crossing = cy + dy > 0 ? cx + (dx - cx) * cy / (cy + dy) : cx;
    if (crossing < 0 || crossing > length) return std::numeric_limits<Scalar>::infinity();
    return std::sqrt((dx - cx) * (dx - cx) + (cy + dy) * (cy + dy));
}

} // namespace detail

template <typename Scalar>
SurfaceGraph<Scalar> surface_graph(const TriangleMesh<Scalar>& mesh, const Triangles& adjacency) {
    struct Link {
        int u, v;
        Scalar length;
    };
    std::vector<Link> links;
    links.reserve(static_cast<std::size_t>(mesh.faces.rows()) * 3);
    std::vector<std::size_t> first(static_cast<std::size_t>(mesh.vertices.rows()) + 1, 0);
    const auto at = [&](int v) { return point(mesh.vertices, v); };
    const auto link = [&](int u, int v, Scalar length) {
        links.push_back({u, v, length});
        ++first[static_cast<std::size_t>(u) + 1];
        ++first[static_cast<std::size_t>(v) + 1];
    };
    for (int f = 0; f < mesh.faces.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int a = mesh.faces(f, k), b = mesh.faces(f, (k + 1) % 3), g = adjacency(f, k);
            if (g >= 0 && g < f) continue; // once per edge
            const Scalar length = (at(b) - at(a)).norm();
            link(a, b, length);
            if (g < 0) continue;
            const int c = mesh.faces(f, (k + 2) % 3);
            int d = mesh.faces(g, 0);
            for (int corner = 1; corner < 3; ++corner)
                if (d == a || d == b) d = mesh.faces(g, corner);
            const Scalar across = detail::unfolded_distance<Scalar>(at(a), at(b), length, at(c), at(d));
            if (std::isfinite(across)) link(c, d, across);
        }
    for (std::size_t v = 1; v < first.size(); ++v) first[v] += first[v - 1];
    std::vector<std::size_t> next(first.begin(), first.end() - 1);
    std::vector<std::pair<int, Scalar>> entries(2 * links.size());
    for (const Link& each : links) {
        entries[next[static_cast<std::size_t>(each.u)]++] = {each.v, each.length};
        entries[next[static_cast<std::size_t>(each.v)]++] = {each.u, each.length};
    }
    return {{std::move(first), std::move(entries)}};
}

template <typename Scalar>
Scalar geodesic_diameter(const SurfaceGraph<Scalar>& surface) {
    constexpr int sweeps = 4; // from any vertex to the end farthest from it, to the end farthest from that one, ...
    Scalar diameter = 0;
    int source = 0;
    for (int sweep = 0; sweep < sweeps; ++sweep) {
        std::vector<Scalar> distance = distances_from(surface, {source});
        for (Scalar& d : distance)
            if (!std::isfinite(d)) d = -1;
        const auto farthest = std::max_element(distance.begin(), distance.end());
        diameter = std::max(diameter, *farthest);
        source = static_cast<int>(std::distance(distance.begin(), farthest));
    }
    return diameter;
}

} // namespace skelgen::core
