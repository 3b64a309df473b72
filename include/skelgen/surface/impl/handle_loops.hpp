#pragma once

#include <skelgen/surface/handle_loops.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include <skelgen/core/curve_graph.hpp>
#include <skelgen/core/disjoint_sets.hpp>
#include <skelgen/core/geometry.hpp>

namespace skelgen::surface {
namespace detail {

/// An edge between two faces.
template <typename Scalar>
struct WeighedEdge {
    std::array<int, 2> vertices, faces;
    Scalar weight;
};

/// The part of its length that an edge in a crease counts: a fifth where the faces meet at a right angle from outside,
/// all of it where they lie in one plane or the edge is a ridge. Calibrated on generated bodies that touch themselves.
template <typename Scalar>
Scalar crease_factor(const TriangleMesh<Scalar>& mesh, int f, int g) {
    constexpr auto least = Scalar(0.2);
    const Vector3<Scalar> nf = core::face_area_vector(mesh, f), ng = core::face_area_vector(mesh, g);
    const auto middle = [&](int face) {
        Vector3<Scalar> sum = Vector3<Scalar>::Zero();
        for (int k = 0; k < 3; ++k) sum += core::point(mesh.vertices, mesh.faces(face, k));
        return Vector3<Scalar>(sum / 3);
    };
    if (!((middle(g) - middle(f)).dot(nf) > 0)) return 1;
    const Scalar angle = std::atan2(nf.cross(ng).norm(), nf.dot(ng));
    return std::max(least, 1 - (1 - least) * angle / (std::numbers::pi_v<Scalar> / 2));
}

template <typename Scalar>
std::vector<WeighedEdge<Scalar>> weighed_edges(const TriangleMesh<Scalar>& mesh, const Triangles& adjacency) {
    std::vector<WeighedEdge<Scalar>> out;
    for (int f = 0; f < mesh.faces.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int g = adjacency(f, k), a = mesh.faces(f, k), b = mesh.faces(f, (k + 1) % 3);
            if (g <= f) continue;
            const Scalar length = (core::point(mesh.vertices, a) - core::point(mesh.vertices, b)).norm();
            out.push_back({{a, b}, {f, g}, length * crease_factor(mesh, f, g)});
        }
    return out;
}

/// The loop that an edge closes with the shortest paths to its ends, without what these share.
template <typename Scalar>
HandleLoop<Scalar> closed_by(const WeighedEdge<Scalar>& edge, const core::ShortestPaths<Scalar>& paths) {
    const auto& [a, b] = edge.vertices;
    std::vector<int> to_a = paths.path_to(a), to_b = paths.path_to(b);
    std::size_t shared = 0;
    while (shared + 1 < std::min(to_a.size(), to_b.size()) && to_a[shared + 1] == to_b[shared + 1]) ++shared;
    const auto distance = [&](int v) { return paths.distance[static_cast<std::size_t>(v)]; };
    HandleLoop<Scalar> out;
    out.length = distance(a) + distance(b) - 2 * distance(to_a[shared]) + edge.weight;
    out.vertices.assign(to_a.begin() + static_cast<std::ptrdiff_t>(shared), to_a.end());
    out.vertices.insert(out.vertices.end(), to_b.rbegin(), to_b.rend() - static_cast<std::ptrdiff_t>(shared) - 1);
    return out;
}

} // namespace detail

template <typename Scalar>
std::vector<Scalar> crease_factors(const TriangleMesh<Scalar>& mesh, const Triangles& adjacency) {
    std::vector<Scalar> out(static_cast<std::size_t>(mesh.vertices.rows()), 1);
    for (int f = 0; f < mesh.faces.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int g = adjacency(f, k);
            if (g <= f) continue;
            const Scalar factor = detail::crease_factor(mesh, f, g);
            for (const int v : {mesh.faces(f, k), mesh.faces(f, (k + 1) % 3)})
                out[static_cast<std::size_t>(v)] = std::min(out[static_cast<std::size_t>(v)], factor);
        }
    return out;
}

template <typename Scalar>
std::vector<HandleLoop<Scalar>> handle_loops(const TriangleMesh<Scalar>& mesh, const Triangles& adjacency, int root) {
    std::vector<detail::WeighedEdge<Scalar>> edges = detail::weighed_edges(mesh, adjacency);
    core::CurveGraph<Scalar> graph;
    graph.neighbours.resize(static_cast<std::size_t>(mesh.vertices.rows()));
    for (const auto& edge : edges)
        for (const int k : {0, 1})
            graph.neighbours[static_cast<std::size_t>(edge.vertices[static_cast<std::size_t>(k)])].emplace_back(
                edge.vertices[static_cast<std::size_t>(1 - k)], edge.weight);
    const core::ShortestPaths<Scalar> paths = core::shortest_paths(graph, root);
    const auto is_in_tree = [&](const detail::WeighedEdge<Scalar>& edge) {
        const auto& [a, b] = edge.vertices;
        return paths.predecessor[static_cast<std::size_t>(a)] == b ||
               paths.predecessor[static_cast<std::size_t>(b)] == a;
    };
    // What the tree of paths leaves is a disc with 2 g bridges, found as what a tree across the faces leaves in turn
    // that takes in the edges of the longest loops first.
    std::erase_if(edges, is_in_tree);
    const auto loop_length = [&](const detail::WeighedEdge<Scalar>& edge) {
        return paths.distance[static_cast<std::size_t>(edge.vertices[0])] +
               paths.distance[static_cast<std::size_t>(edge.vertices[1])] + edge.weight;
    };
    std::stable_sort(edges.begin(), edges.end(),
                     [&](const auto& a, const auto& b) { return loop_length(a) > loop_length(b); });
    core::DisjointSets across(static_cast<std::size_t>(mesh.faces.rows()));
    std::vector<HandleLoop<Scalar>> out;
    for (const auto& edge : edges)
        if (!across.unite(static_cast<std::size_t>(edge.faces[0]), static_cast<std::size_t>(edge.faces[1])))
            out.push_back(detail::closed_by(edge, paths));
    std::stable_sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.length < b.length; });
    return out;
}

} // namespace skelgen::surface
