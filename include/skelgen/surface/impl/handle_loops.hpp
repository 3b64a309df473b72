#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <type_traits>
#include <utility>
#include <vector>

#include <skelgen/core/curve_graph.hpp>
#include <skelgen/core/disjoint_sets.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/core/sort_by_number.hpp>

namespace skelgen::surface {

/// An edge between two faces; its weight is its length, or less of it in a crease: a fifth where the faces meet at a
/// right angle and sharper, all of it where they lie in one plane or the edge is a ridge.
template <typename Scalar = double>
struct CreaseEdge {
    std::array<int, 2> vertices, faces;
    Scalar weight;
};

/// A surface's edges, weighed by the creases in which they lie.
template <typename Scalar = double>
struct CreaseGraph {
    std::vector<CreaseEdge<Scalar>> edges;
    core::SurfaceGraph<Scalar> graph; ///< the vertices, as far from each other as the edges weigh
    std::vector<Scalar> factors;      ///< per vertex the least part of its length that an edge there counts
    std::size_t faces = 0;
};

/// A closed path along edges of a surface that does not part it: around a handle, or through one.
template <typename Scalar = double>
struct HandleLoop {
    std::vector<int> vertices; ///< in order, each once
    Scalar length = 0;         ///< the sum of its edges' weights
};

namespace detail {

/// Where a face is, and how it lies.
template <typename Scalar>
struct FacePlace {
    Vector3<Scalar> middle, area;
};

template <typename Scalar>
std::vector<FacePlace<Scalar>> places_of_faces(const TriangleMesh<Scalar>& mesh) {
    std::vector<FacePlace<Scalar>> out(static_cast<std::size_t>(mesh.faces.rows()));
    for (std::size_t f = 0; f < out.size(); ++f) {
        const auto row = static_cast<Eigen::Index>(f);
        Vector3<Scalar> sum = Vector3<Scalar>::Zero();
        for (int k = 0; k < 3; ++k) sum += core::point(mesh.vertices, mesh.faces(row, k));
        out[f] = {Vector3<Scalar>(sum / 3), core::face_area_vector(mesh, row)};
    }
    return out;
}

/// The part of its length that the edge between two faces counts; calibrated on generated bodies that touch themselves.
template <typename Scalar>
Scalar crease_factor(const FacePlace<Scalar>& f, const FacePlace<Scalar>& g) {
    constexpr auto least = Scalar(0.2);
    if (!((g.middle - f.middle).dot(f.area) > 0)) return 1;
    const Scalar angle = std::atan2(f.area.cross(g.area).norm(), f.area.dot(g.area));
    return std::max(least, 1 - (1 - least) * angle / (std::numbers::pi_v<Scalar> / 2));
}

/// The neighbours of so many vertices along edges, in the edges' order.
template <typename Scalar>
core::NeighbourLists<Scalar> neighbours_along(const std::vector<CreaseEdge<Scalar>>& edges, std::size_t vertices) {
    std::vector<std::size_t> first(vertices + 1, 0);
    for (const CreaseEdge<Scalar>& edge : edges)
        for (const int v : edge.vertices) ++first[static_cast<std::size_t>(v) + 1];
    for (std::size_t v = 0; v < vertices; ++v) first[v + 1] += first[v];
    std::vector<typename core::NeighbourLists<Scalar>::Entry> entries(first.back());
    std::vector<std::size_t> next = first;
    for (const auto& [ends, faces, weight] : edges) {
        entries[next[static_cast<std::size_t>(ends[0])]++] = {ends[1], weight};
        entries[next[static_cast<std::size_t>(ends[1])]++] = {ends[0], weight};
    }
    return {std::move(first), std::move(entries)};
}

/// The loop that an edge closes with the shortest paths to its ends, without what these share.
template <typename Scalar>
HandleLoop<Scalar> closed_by(const CreaseEdge<Scalar>& edge, const core::ShortestPaths<Scalar>& paths) {
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

/// `mesh` must be closed and manifold, `adjacency` as from core::face_adjacency. O(n).
template <typename Scalar>
CreaseGraph<Scalar> crease_graph(const TriangleMesh<Scalar>& mesh, const Triangles& adjacency) {
    CreaseGraph<Scalar> out;
    const auto vertices = static_cast<std::size_t>(mesh.vertices.rows());
    const std::vector<detail::FacePlace<Scalar>> places = detail::places_of_faces(mesh);
    out.factors.assign(vertices, 1);
    out.faces = places.size();
    out.edges.reserve(out.faces / 2 * 3);
    for (int f = 0; f < mesh.faces.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int g = adjacency(f, k), a = mesh.faces(f, k), b = mesh.faces(f, (k + 1) % 3);
            if (g <= f) continue;
            const Scalar factor =
                detail::crease_factor(places[static_cast<std::size_t>(f)], places[static_cast<std::size_t>(g)]);
            const Scalar weight = (core::point(mesh.vertices, a) - core::point(mesh.vertices, b)).norm() * factor;
            out.edges.push_back({{a, b}, {f, g}, weight});
            for (const int v : {a, b})
                out.factors[static_cast<std::size_t>(v)] = std::min(out.factors[static_cast<std::size_t>(v)], factor);
        }
    out.graph.neighbours = detail::neighbours_along(out.edges, vertices);
    return out;
}

/// Two loops for each handle of a closed connected surface, which together span all of its loops: of those through
/// `root` a shortest such set (EW05), without the ways from there that they go forth and back. Where limbs have grown
/// together the shortest loops run along the seam. By length; of those that are longer than `longest` with the ways
/// back and forth, none. O(n log n + genus n), within `longest` O(n + k log k) for the k vertices not half as far.
template <typename Scalar>
std::vector<HandleLoop<Scalar>>
handle_loops(const CreaseGraph<Scalar>& surface, int root,
             std::type_identity_t<Scalar> longest = std::numeric_limits<Scalar>::infinity()) {
    using Edge = CreaseEdge<Scalar>;
    // Neither end of the edge that closes a loop is farther along the shortest paths than half of the loop.
    const core::ShortestPaths<Scalar> paths = core::shortest_paths(surface.graph, root, longest / 2);
    // What the tree of paths leaves is a disc with 2 g bridges, found as what a tree across the faces leaves in turn
    // that takes in the edges of the longest loops first. Of those that are too long any may come first.
    core::DisjointSets across(surface.faces);
    const auto unite = [&](const Edge& edge) {
        return across.unite(static_cast<std::size_t>(edge.faces[0]), static_cast<std::size_t>(edge.faces[1]));
    };
    std::vector<std::pair<Scalar, int>> closing; // the length of the loop, less than nothing, and the edge
    for (std::size_t i = 0; i < surface.edges.size(); ++i) {
        const Edge& edge = surface.edges[i];
        const auto a = static_cast<std::size_t>(edge.vertices[0]), b = static_cast<std::size_t>(edge.vertices[1]);
        if (paths.predecessor[a] == edge.vertices[1] || paths.predecessor[b] == edge.vertices[0]) continue;
        const Scalar length = paths.distance[a] + paths.distance[b] + edge.weight;
        if (length <= longest && std::isfinite(length))
            closing.emplace_back(-length, static_cast<int>(i));
        else
            unite(edge);
    }
    std::vector<HandleLoop<Scalar>> out;
    for (const auto& [length, edge] : core::sorted_by_number(std::move(closing)))
        if (const Edge& closed = surface.edges[static_cast<std::size_t>(edge)]; !unite(closed))
            out.push_back(detail::closed_by(closed, paths));
    std::stable_sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.length < b.length; });
    return out;
}

} // namespace skelgen::surface
