#pragma once

#include <algorithm>
#include <limits>
#include <queue>
#include <tuple>
#include <utility>
#include <vector>

#include <skelgen/core/curve_skeleton.hpp>

namespace skelgen {

/// Adjacency lists of a curve skeleton with edge lengths; neighbours in ascending order.
template <typename Scalar = double>
struct CurveGraph {
    std::vector<std::vector<std::pair<int, Scalar>>> neighbours;

    [[nodiscard]] int size() const { return static_cast<int>(neighbours.size()); }
    [[nodiscard]] int degree(int node) const {
        return static_cast<int>(neighbours[static_cast<std::size_t>(node)].size());
    }
};

template <typename Scalar>
[[nodiscard]] CurveGraph<Scalar> curve_graph(const CurveSkeleton<Scalar>& curve) {
    CurveGraph<Scalar> graph;
    graph.neighbours.resize(static_cast<std::size_t>(curve.nodes.rows()));
    for (const auto& [a, b] : curve.edges) {
        const Scalar length = (curve.nodes.row(a) - curve.nodes.row(b)).norm();
        graph.neighbours[static_cast<std::size_t>(a)].emplace_back(b, length);
        graph.neighbours[static_cast<std::size_t>(b)].emplace_back(a, length);
    }
    for (auto& list : graph.neighbours) std::sort(list.begin(), list.end());
    return graph;
}

/// Independent cycles of a connected curve: 0 for a tree.
template <typename Scalar>
[[nodiscard]] int cycle_count(const CurveSkeleton<Scalar>& curve) {
    return static_cast<int>(curve.edges.size()) - static_cast<int>(curve.nodes.rows()) + 1;
}

/// Shortest paths from one node: distances (infinite where there is no path) and predecessors (-1 at the source).
template <typename Scalar = double>
struct ShortestPaths {
    std::vector<Scalar> distance;
    std::vector<int> predecessor;

    /// Nodes from the source to `target`, both included.
    [[nodiscard]] std::vector<int> path_to(int target) const {
        std::vector<int> path;
        for (int v = target; v >= 0; v = predecessor[static_cast<std::size_t>(v)]) path.push_back(v);
        std::reverse(path.begin(), path.end());
        return path;
    }
};

/// Dijkstra on the curve. O((k + edges) log k).
template <typename Scalar>
[[nodiscard]] ShortestPaths<Scalar> shortest_paths(const CurveGraph<Scalar>& graph, int source) {
    ShortestPaths<Scalar> out;
    out.distance.assign(graph.neighbours.size(), std::numeric_limits<Scalar>::infinity());
    out.predecessor.assign(graph.neighbours.size(), -1);
    std::priority_queue<std::pair<Scalar, int>, std::vector<std::pair<Scalar, int>>, std::greater<>> queue;
    out.distance[static_cast<std::size_t>(source)] = 0;
    queue.emplace(Scalar(0), source);
    while (!queue.empty()) {
        const auto [distance, v] = queue.top();
        queue.pop();
        if (distance > out.distance[static_cast<std::size_t>(v)]) continue;
        for (const auto& [w, length] : graph.neighbours[static_cast<std::size_t>(v)]) {
            const Scalar candidate = distance + length;
            if (!(candidate < out.distance[static_cast<std::size_t>(w)])) continue;
            out.distance[static_cast<std::size_t>(w)] = candidate;
            out.predecessor[static_cast<std::size_t>(w)] = v;
            queue.emplace(candidate, w);
        }
    }
    return out;
}

/// Per node the index of the source nearest along the graph (the lowest one among equals), -1 where none can be
/// reached. O((k + edges) log k).
template <typename Scalar>
[[nodiscard]] std::vector<int> nearest_source(const CurveGraph<Scalar>& graph, const std::vector<int>& sources) {
    using Claim = std::tuple<Scalar, int, int>; // distance, source, node
    std::vector<int> owner(graph.neighbours.size(), -1);
    std::priority_queue<Claim, std::vector<Claim>, std::greater<>> queue;
    for (std::size_t s = 0; s < sources.size(); ++s) queue.emplace(Scalar(0), static_cast<int>(s), sources[s]);
    while (!queue.empty()) {
        const auto [distance, source, v] = queue.top();
        queue.pop();
        if (owner[static_cast<std::size_t>(v)] >= 0) continue;
        owner[static_cast<std::size_t>(v)] = source;
        for (const auto& [w, length] : graph.neighbours[static_cast<std::size_t>(v)])
            if (owner[static_cast<std::size_t>(w)] < 0) queue.emplace(distance + length, source, w);
    }
    return owner;
}

/// Largest distance along the curve between any two of its nodes. O(k^2 log k).
template <typename Scalar>
[[nodiscard]] Scalar curve_diameter(const CurveGraph<Scalar>& graph) {
    Scalar diameter = 0;
    for (int v = 0; v < graph.size(); ++v)
        for (const Scalar d : shortest_paths(graph, v).distance)
            if (d < std::numeric_limits<Scalar>::infinity()) diameter = std::max(diameter, d);
    return diameter;
}

} // namespace skelgen
