#pragma once

#include <algorithm>
#include <vector>

#include <skelgen/core/mesh.hpp>

namespace skelgen::core {

/// For each face and each of its edges k (from corner k to k + 1) the face on the other side, -1 at a boundary; m x 3.
/// The mesh must be edge-manifold. O(m log m).
[[nodiscard]] inline Triangles face_adjacency(const Triangles& faces) {
    struct Edge {
        int low, high, face, side;
    };
    std::vector<Edge> edges;
    edges.reserve(static_cast<std::size_t>(faces.rows()) * 3);
    for (int f = 0; f < faces.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int u = faces(f, k), v = faces(f, (k + 1) % 3);
            edges.push_back({std::min(u, v), std::max(u, v), f, k});
        }
    std::sort(edges.begin(), edges.end(),
              [](const Edge& a, const Edge& b) { return a.low != b.low ? a.low < b.low : a.high < b.high; });
    Triangles adjacency = Triangles::Constant(faces.rows(), 3, -1);
    for (std::size_t i = 0; i + 1 < edges.size(); ++i)
        if (edges[i].low == edges[i + 1].low && edges[i].high == edges[i + 1].high) {
            adjacency(edges[i].face, edges[i].side) = edges[i + 1].face;
            adjacency(edges[i + 1].face, edges[i + 1].side) = edges[i].face;
        }
    return adjacency;
}

} // namespace skelgen::core
