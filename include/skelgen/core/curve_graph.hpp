#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include <skelgen/core/curve_skeleton.hpp>
#include <skelgen/core/disjoint_sets.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/precision.hpp>

namespace skelgen::core {

/// Adjacency lists of a curve skeleton with edge lengths; neighbours in ascending order.
template <typename Scalar = double>
struct CurveGraph {
    std::vector<std::vector<std::pair<int, Scalar>>> neighbours;

    [[nodiscard]] int size() const { return static_cast<int>(neighbours.size()); }
    [[nodiscard]] int degree(int node) const {
        return static_cast<int>(neighbours[static_cast<std::size_t>(node)].size());
    }
};

/// The neighbours of many nodes, one list after the other.
template <typename Scalar = double>
class NeighbourLists {
public:
    using Entry = std::pair<int, Scalar>; ///< a neighbour and how far it is

    NeighbourLists() = default;
    /// \param first where each node's list begins, and at last where all end.
    NeighbourLists(std::vector<std::size_t> first, std::vector<Entry> entries)
        : first_(std::move(first)), entries_(std::move(entries)) {
        Accumulator sum = 0;
        for (const auto& [node, length] : entries_) {
            sum += length;
            longest_ = std::max(longest_, length);
        }
        mean_ = static_cast<Scalar>(sum / static_cast<Accumulator>(entries_.size() + 1));
    }

    [[nodiscard]] std::size_t size() const { return first_.empty() ? 0 : first_.size() - 1; }
    [[nodiscard]] std::span<const Entry> operator[](std::size_t node) const {
        return {entries_.data() + first_[node], first_[node + 1] - first_[node]};
    }
    [[nodiscard]] Scalar longest() const { return longest_; }
    [[nodiscard]] Scalar mean() const { return mean_; } ///< of the ways to neighbours, about

private:
    std::vector<std::size_t> first_;
    std::vector<Entry> entries_;
    Scalar longest_ = 0, mean_ = 0;
};

/// A graph of the many vertices of a surface, as a CurveGraph but for where the lists are.
template <typename Scalar = double>
struct SurfaceGraph {
    NeighbourLists<Scalar> neighbours;

    [[nodiscard]] int size() const { return static_cast<int>(neighbours.size()); }
};

template <typename Scalar>
[[nodiscard]] CurveGraph<Scalar> curve_graph(const CurveSkeleton<Scalar>& curve) {
    CurveGraph<Scalar> graph;
    graph.neighbours.resize(static_cast<std::size_t>(curve.nodes.rows()));
    for (const auto& [a, b] : curve.edges) {
        const Scalar length = (point(curve.nodes, a) - point(curve.nodes, b)).norm();
        graph.neighbours[static_cast<std::size_t>(a)].emplace_back(b, length);
        graph.neighbours[static_cast<std::size_t>(b)].emplace_back(a, length);
    }
    for (auto& list : graph.neighbours) std::sort(list.begin(), list.end());
    return graph;
}

/// The nodes from `start` through its neighbour `first` on to the next one that is not of degree 2 (or back to `start`,
/// on a ring without any), both ends included. O(nodes of the branch).
template <typename Scalar>
[[nodiscard]] std::vector<int> branch(const CurveGraph<Scalar>& graph, int start, int first) {
    std::vector<int> nodes{start, first};
    while (graph.degree(nodes.back()) == 2 && nodes.back() != start) {
        const auto& list = graph.neighbours[static_cast<std::size_t>(nodes.back())];
        nodes.push_back(list[0].first == nodes[nodes.size() - 2] ? list[1].first : list[0].first);
    }
    return nodes;
}

/// All branches, each once: the nodes from one that is not of degree 2 to the next one, in ascending order of their
/// starts; a ring without such a node starts and ends at its lowest. Nodes without edges are in none. O(k + edges).
template <typename Scalar>
[[nodiscard]] std::vector<std::vector<int>> branches(const CurveGraph<Scalar>& graph) {
    std::vector<std::vector<int>> out;
    std::vector<bool> reached(graph.neighbours.size(), false);
    const auto add_from = [&](int start) {
        for (const auto& [first, length] : graph.neighbours[static_cast<std::size_t>(start)]) {
            std::vector<int> path = branch(graph, start, first);
            const auto there = std::pair(path.back(), path[path.size() - 2]);
            if (there < std::pair(start, first)) continue; // seen from there
            for (const int node : path) reached[static_cast<std::size_t>(node)] = true;
            out.push_back(std::move(path));
        }
    };
    for (int v = 0; v < graph.size(); ++v)
        if (graph.degree(v) != 2) add_from(v);
    for (int v = 0; v < graph.size(); ++v)
        if (graph.degree(v) == 2 && !reached[static_cast<std::size_t>(v)]) add_from(v);
    return out;
}

/// Length of the polyline through these nodes of a curve. O(nodes).
template <typename Scalar>
[[nodiscard]] Scalar path_length(const CurveSkeleton<Scalar>& curve, const std::vector<int>& nodes) {
    Scalar length = 0;
    for (std::size_t i = 1; i < nodes.size(); ++i)
        length += (point(curve.nodes, nodes[i]) - point(curve.nodes, nodes[i - 1])).norm();
    return length;
}

/// Node of a curve nearest to a point, the first of equals; the curve must have one. O(k).
template <typename Scalar>
[[nodiscard]] int nearest_node(const CurveSkeleton<Scalar>& curve, const Vector3<Scalar>& place) {
    return nearest_point(curve.nodes, place);
}

/// The nodes with that many edges, in ascending order; with one, they are the curve's ends. O(k + edges log edges).
template <typename Scalar>
[[nodiscard]] std::vector<int> nodes_of_degree(const CurveSkeleton<Scalar>& curve, int degree) {
    const CurveGraph<Scalar> graph = curve_graph(curve);
    std::vector<int> nodes;
    for (int v = 0; v < graph.size(); ++v)
        if (graph.degree(v) == degree) nodes.push_back(v);
    return nodes;
}

/// Ends of a curve: its nodes with one edge. O(k + edges log edges).
template <typename Scalar>
[[nodiscard]] int end_count(const CurveSkeleton<Scalar>& curve) {
    return static_cast<int>(nodes_of_degree(curve, 1).size());
}

/// Connected components of a curve, of which a node without edges is one. O(k + edges log k).
template <typename Scalar>
[[nodiscard]] int component_count(const CurveSkeleton<Scalar>& curve) {
    DisjointSets components(static_cast<std::size_t>(curve.nodes.rows()));
    for (const auto& [a, b] : curve.edges) components.unite(static_cast<std::size_t>(a), static_cast<std::size_t>(b));
    return static_cast<int>(components.count());
}

/// Independent cycles of a curve, those of all its components: 0 for trees. As `component_count`.
template <typename Scalar>
[[nodiscard]] int cycle_count(const CurveSkeleton<Scalar>& curve) {
    return static_cast<int>(curve.edges.size()) - static_cast<int>(curve.nodes.rows()) + component_count(curve);
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

/// Dijkstra on the curve, no farther than `farthest`. O((k + edges) log k) for the k nodes within.
template <typename Scalar>
[[nodiscard]] ShortestPaths<Scalar>
shortest_paths(const CurveGraph<Scalar>& graph, int source,
               std::type_identity_t<Scalar> farthest = std::numeric_limits<Scalar>::infinity());

/// The same on a surface.
template <typename Scalar>
[[nodiscard]] ShortestPaths<Scalar>
shortest_paths(const SurfaceGraph<Scalar>& graph, int source,
               std::type_identity_t<Scalar> farthest = std::numeric_limits<Scalar>::infinity());

/// Distances of all nodes to the nearest of some, infinite where no path leads: as by `shortest_paths`, faster. O(k +
/// links) where links are about equally long.
template <typename Scalar>
[[nodiscard]] std::vector<Scalar> distances_from(const SurfaceGraph<Scalar>& graph, const std::vector<int>& sources);

/// Where a search for the nearest begins.
template <typename Scalar = double>
struct Source {
    Scalar distance = 0; ///< that it begins with
    int label = 0;       ///< what is found by it; not negative
    int node = 0;
};

/// Per node the label of the source nearest along the graph, its own distance included (the lowest label among equals),
/// -1 where none can be reached. O((k + edges + sources) log k).
template <typename Scalar>
[[nodiscard]] std::vector<int> nearest_source(const SurfaceGraph<Scalar>& graph,
                                              const std::vector<Source<Scalar>>& sources);

/// The same on a curve.
template <typename Scalar>
[[nodiscard]] std::vector<int> nearest_source(const CurveGraph<Scalar>& graph,
                                              const std::vector<Source<Scalar>>& sources);

/// Largest distance along the curve between any two of its nodes that are connected. O(k log k) for each component that
/// is a tree; some of the j nodes of one with cycles, all of them at worst, cost as much as a tree of j nodes.
template <typename Scalar>
[[nodiscard]] Scalar curve_diameter(const CurveGraph<Scalar>& graph);

} // namespace skelgen::core

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/core/impl/curve_graph.hpp>
#endif
