#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <skelgen/core/mesh.hpp>
#include <skelgen/core/parallel.hpp>

namespace skelgen::core {

/// A directed edge of a face, and the corner (3 f + k) at which it starts.
struct DirectedEdge {
    int low, high; ///< its vertices
    std::uint32_t corner;
    bool forward; ///< runs from low to high

    [[nodiscard]] bool joins_same(const DirectedEdge& other) const { return low == other.low && high == other.high; }
};

/// The edges of all faces, 3 m, ordered by `low`, `high` and `corner`: those between the same vertices lie together.
/// Vertices are numbered from 0; of faces there are 2^32 / 3 at most. O(n + m) where vertices have few edges.
[[nodiscard]] inline std::vector<DirectedEdge> directed_edges(const Triangles& faces) {
    const std::size_t vertices = faces.size() > 0 ? static_cast<std::size_t>(faces.maxCoeff()) + 1 : 0;
    const auto edge_at = [&](Eigen::Index f, int k) {
        const int u = faces(f, k), v = faces(f, (k + 1) % 3);
        return DirectedEdge{std::min(u, v), std::max(u, v), static_cast<std::uint32_t>(3 * f + k), u < v};
    };
    std::vector<std::size_t> begin(vertices + 1, 0); // of each vertex's edges
    for (Eigen::Index f = 0; f < faces.rows(); ++f)
        for (int k = 0; k < 3; ++k) ++begin[static_cast<std::size_t>(edge_at(f, k).low) + 1];
    for (std::size_t v = 0; v < vertices; ++v) begin[v + 1] += begin[v];
    std::vector<DirectedEdge> edges(static_cast<std::size_t>(faces.size()));
    std::vector<std::size_t> next = begin;
    for (Eigen::Index f = 0; f < faces.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            const DirectedEdge edge = edge_at(f, k);
            edges[next[static_cast<std::size_t>(edge.low)]++] = edge;
        }
    constexpr std::size_t in_a_row = 4096;
    parallel_for(vertices, in_a_row, [&](std::size_t v) {
        std::sort(edges.begin() + static_cast<std::ptrdiff_t>(begin[v]),
                  edges.begin() + static_cast<std::ptrdiff_t>(begin[v + 1]),
                  [](const DirectedEdge& a, const DirectedEdge& b) {
                      return a.high != b.high ? a.high < b.high : a.corner < b.corner;
                  });
    });
    return edges;
}

/// The edges between two vertices each, the lower one first, in ascending order. O(n + m) where vertices have few
/// edges.
[[nodiscard]] inline std::vector<std::array<int, 2>> edges_of(const Triangles& faces) {
    const std::size_t vertices = faces.size() > 0 ? static_cast<std::size_t>(faces.maxCoeff()) + 1 : 0;
    const auto visit = [&](const auto& edge) {
        for (Eigen::Index f = 0; f < faces.rows(); ++f)
            for (int k = 0; k < 3; ++k) {
                const int u = faces(f, k), v = faces(f, (k + 1) % 3);
                edge(static_cast<std::size_t>(std::min(u, v)), std::max(u, v));
            }
    };
    std::vector<std::size_t> end(vertices + 1, 0); // of each vertex's list of higher neighbours
    visit([&](std::size_t low, int) { ++end[low + 1]; });
    for (std::size_t v = 0; v < vertices; ++v) end[v + 1] += end[v];
    std::vector<int> higher(static_cast<std::size_t>(faces.size()));
    visit([&](std::size_t low, int high) { higher[end[low]++] = high; });
    std::vector<std::array<int, 2>> out;
    out.reserve(higher.size() / 2 + 1);
    for (std::size_t v = 0, begin = 0; v < vertices; begin = end[v++]) {
        std::sort(higher.begin() + static_cast<std::ptrdiff_t>(begin),
                  higher.begin() + static_cast<std::ptrdiff_t>(end[v]));
        for (std::size_t i = begin; i < end[v]; ++i)
            if (i == begin || higher[i] != higher[i - 1]) out.push_back({static_cast<int>(v), higher[i]});
    }
    return out;
}

/// For each face and each of its edges k (from corner k to k + 1) the face on the other side, -1 at a boundary; m x 3.
/// The mesh must be edge-manifold. O(n + m) where vertices have few edges.
[[nodiscard]] inline Triangles face_adjacency(const Triangles& faces) {
    const std::vector<DirectedEdge> edges = directed_edges(faces);
    Triangles adjacency = Triangles::Constant(faces.rows(), 3, -1);
    for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
        if (!edges[i].joins_same(edges[i + 1])) continue;
        const std::size_t a = edges[i].corner, b = edges[i + 1].corner;
        adjacency.data()[a] = static_cast<int>(b / 3);
        adjacency.data()[b] = static_cast<int>(a / 3);
    }
    return adjacency;
}

} // namespace skelgen::core
