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

namespace detail {

/// The node farthest from another one, of those connected to it, and how far that is.
template <typename Scalar>
std::pair<Scalar, int> farthest(const CurveGraph<Scalar>& graph, int from) {
    std::pair<Scalar, int> found{0, from};
    const std::vector<Scalar> distance = shortest_paths(graph, from).distance;
    for (int v = 0; v < graph.size(); ++v)
        if (const Scalar d = distance[static_cast<std::size_t>(v)];
            d < std::numeric_limits<Scalar>::infinity() && d > found.first)
            found = {d, v};
    return found;
}

/// The nodes connected to one, itself included.
template <typename Scalar>
std::vector<int> component_of(const CurveGraph<Scalar>& graph, int start) {
    const std::vector<Scalar> distance = shortest_paths(graph, start).distance;
    std::vector<int> nodes;
    for (int v = 0; v < graph.size(); ++v)
        if (distance[static_cast<std::size_t>(v)] < std::numeric_limits<Scalar>::infinity()) nodes.push_back(v);
    return nodes;
}

/// The diameter of that component. In a tree, the node farthest from any other is an end of a longest path, so that no
/// more than its two ends are to be looked from: from both, as sums in opposite orders round differently.
template <typename Scalar>
Scalar component_diameter(const CurveGraph<Scalar>& graph, const std::vector<int>& component) {
    std::size_t degrees = 0;
    for (const int v : component) degrees += graph.neighbours[static_cast<std::size_t>(v)].size();
    if (degrees == 2 * (component.size() - 1)) {
        const int end = farthest(graph, component.front()).second;
        const auto [length, other_end] = farthest(graph, end);
        return std::max(length, farthest(graph, other_end).first);
    }
    Scalar diameter = 0;
    for (const int v : component) diameter = std::max(diameter, farthest(graph, v).first);
    return diameter;
}

} // namespace detail

template <typename Scalar>
Scalar curve_diameter(const CurveGraph<Scalar>& graph) {
    Scalar diameter = 0;
    std::vector<bool> measured(graph.neighbours.size(), false);
    for (int start = 0; start < graph.size(); ++start) {
        if (measured[static_cast<std::size_t>(start)]) continue;
        const std::vector<int> component = detail::component_of(graph, start);
        for (const int v : component) measured[static_cast<std::size_t>(v)] = true;
        diameter = std::max(diameter, detail::component_diameter(graph, component));
    }
    return diameter;
}

} // namespace skelgen::core
