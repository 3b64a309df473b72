#pragma once

#include <skelgen/core/curve_graph.hpp>

#include <functional>
#include <limits>
#include <queue>
#include <tuple>

namespace skelgen::core {

template <typename Scalar>
ShortestPaths<Scalar> shortest_paths(const CurveGraph<Scalar>& graph, int source) {
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

template <typename Scalar>
std::vector<int> nearest_source(const CurveGraph<Scalar>& graph, const std::vector<int>& sources) {
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

template <typename Scalar>
Scalar curve_diameter(const CurveGraph<Scalar>& graph) {
    Scalar diameter = 0;
    for (int v = 0; v < graph.size(); ++v)
        for (const Scalar d : shortest_paths(graph, v).distance)
            if (d < std::numeric_limits<Scalar>::infinity()) diameter = std::max(diameter, d);
    return diameter;
}

} // namespace skelgen::core
