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
std::vector<int> nearest_source(const CurveGraph<Scalar>& graph, const std::vector<Source<Scalar>>& sources) {
    using Claim = std::tuple<Scalar, int, int>; // distance, label, node
    std::vector<std::pair<Scalar, int>> best(graph.neighbours.size(), {std::numeric_limits<Scalar>::infinity(), -1});
    std::priority_queue<Claim, std::vector<Claim>, std::greater<>> queue;
    const auto claim = [&](Scalar distance, int label, int node) {
        std::pair<Scalar, int>& known = best[static_cast<std::size_t>(node)];
        const bool nearer = distance < known.first || (distance == known.first && label < known.second);
        if (known.second >= 0 && !nearer) return;
        known = {distance, label};
        queue.emplace(distance, label, node);
    };
    for (const Source<Scalar>& source : sources) claim(source.distance, source.label, source.node);
    while (!queue.empty()) {
        const auto [distance, label, v] = queue.top();
        queue.pop();
        if (best[static_cast<std::size_t>(v)] != std::pair(distance, label)) continue;
        for (const auto& [w, length] : graph.neighbours[static_cast<std::size_t>(v)])
            claim(distance + length, label, w);
    }
    std::vector<int> labels;
    labels.reserve(best.size());
    for (const auto& [distance, label] : best) labels.push_back(label);
    return labels;
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
