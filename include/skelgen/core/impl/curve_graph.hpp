#pragma once

#include <skelgen/core/curve_graph.hpp>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <functional>
#include <limits>
#include <queue>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include <skelgen/core/precision.hpp>

namespace skelgen::core {

namespace detail {

/// As shortest_paths, on either kind of graph.
template <typename Scalar, typename Graph>
ShortestPaths<Scalar> paths_from(const Graph& graph, int source, Scalar farthest) {
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
            if (!(candidate < out.distance[static_cast<std::size_t>(w)]) || candidate > farthest) continue;
            out.distance[static_cast<std::size_t>(w)] = candidate;
            out.predecessor[static_cast<std::size_t>(w)] = v;
            queue.emplace(candidate, w);
        }
    }
    return out;
}

} // namespace detail

template <typename Scalar>
ShortestPaths<Scalar> shortest_paths(const CurveGraph<Scalar>& graph, int source,
                                     std::type_identity_t<Scalar> farthest) {
    return detail::paths_from<Scalar>(graph, source, farthest);
}

template <typename Scalar>
ShortestPaths<Scalar> shortest_paths(const SurfaceGraph<Scalar>& graph, int source,
                                     std::type_identity_t<Scalar> farthest) {
    return detail::paths_from<Scalar>(graph, source, farthest);
}

namespace detail {

/// What is known of the way to a node: how far it is, or that and the label of the source that it leads from, -1 for
/// none. Of two that are as far, that with the lower label is nearer.
template <typename Scalar>
using Labelled = std::pair<Scalar, int>;

template <typename Scalar>
Scalar distance_of(Scalar way) {
    return way;
}
template <typename Scalar>
Scalar distance_of(const Labelled<Scalar>& way) {
    return way.first;
}
template <typename Scalar>
Scalar with_link(Scalar way, Scalar length) {
    return way + length;
}
template <typename Scalar>
Labelled<Scalar> with_link(const Labelled<Scalar>& way, Scalar length) {
    return {way.first + length, way.second};
}
template <typename Scalar>
bool is_nearer(Scalar way, Scalar known) {
    return way < known;
}
template <typename Scalar>
bool is_nearer(const Labelled<Scalar>& way, const Labelled<Scalar>& known) {
    if (way.first > known.first) return false; // as most are
    return known.second < 0 || way < known;
}

/// A node, and a way to it.
template <typename Way>
struct WayTo {
    Way way;
    int node;
};

/// The nearest way to each node from some sources; `none` where none leads. Nodes wait in slots for distances of half a
/// link's length, in any order (Dia69): what a slot's nodes change in that slot is looked at again, so that the
/// distances are those of the shortest paths all the same.
template <typename Way, typename Scalar>
std::vector<Way> nearest_by_slots(const SurfaceGraph<Scalar>& graph, std::vector<WayTo<Way>> sources, const Way& none) {
    constexpr Scalar most_slots = 4096;
    std::vector<Way> best(graph.neighbours.size(), none);
    const auto is_best = [&](const WayTo<Way>& one) { return best[static_cast<std::size_t>(one.node)] == one.way; };
    const auto take_if_nearer = [&](const Way& way, int node) {
        Way& known = best[static_cast<std::size_t>(node)];
        if (!is_nearer(way, known)) return false;
        known = way;
        return true;
    };
    for (const WayTo<Way>& source : sources) take_if_nearer(source.way, source.node);
    std::erase_if(sources, [&](const WayTo<Way>& source) { return !is_best(source); });
    if (sources.empty()) return best;
    std::sort(sources.begin(), sources.end(),
              [](const auto& a, const auto& b) { return distance_of(a.way) < distance_of(b.way); });
    const Scalar longest = graph.neighbours.longest(), mean = graph.neighbours.mean();
    const Scalar width = std::max(mean / 2, longest / most_slots), base = distance_of(sources.front().way);
    const Scalar per_length = width > 0 ? 1 / width : Scalar(0);
    const std::size_t slots = std::bit_ceil(static_cast<std::size_t>(longest * per_length) + 2);
    const auto slot_of = [&](const Way& way) {
        return static_cast<std::size_t>((distance_of(way) - base) * per_length);
    };
    std::vector<std::vector<WayTo<Way>>> waiting(slots); // slot k, k + slots, ... in one
    std::size_t pending = 0;
    auto source = sources.begin();
    for (std::size_t slot = 0; pending > 0 || source != sources.end(); ++slot) {
        if (pending == 0) slot = slot_of(source->way);
        std::vector<WayTo<Way>>& here = waiting[slot & (slots - 1)];
        for (; source != sources.end() && slot_of(source->way) <= slot; ++source) {
            here.push_back(*source);
            ++pending;
        }
        while (!here.empty()) {
            const WayTo<Way> next = here.back();
            here.pop_back();
            --pending;
            if (!is_best(next)) continue;
            for (const auto& [node, length] : graph.neighbours[static_cast<std::size_t>(next.node)]) {
                const Way way = with_link(next.way, length);
                if (!take_if_nearer(way, node)) continue;
                waiting[slot_of(way) & (slots - 1)].push_back({way, node});
                ++pending;
            }
        }
    }
    return best;
}

} // namespace detail

template <typename Scalar>
std::vector<Scalar> distances_from(const SurfaceGraph<Scalar>& graph, const std::vector<int>& sources) {
    std::vector<detail::WayTo<Scalar>> all;
    for (const int node : sources) all.push_back({Scalar(0), node});
    return detail::nearest_by_slots(graph, std::move(all), std::numeric_limits<Scalar>::infinity());
}

template <typename Scalar>
std::vector<int> nearest_source(const SurfaceGraph<Scalar>& graph, const std::vector<Source<Scalar>>& sources) {
    using Way = detail::Labelled<Scalar>;
    std::vector<detail::WayTo<Way>> all;
    for (const Source<Scalar>& source : sources) all.push_back({{source.distance, source.label}, source.node});
    std::vector<int> labels;
    labels.reserve(graph.neighbours.size());
    for (const auto& [distance, label] :
         detail::nearest_by_slots(graph, std::move(all), Way(std::numeric_limits<Scalar>::infinity(), -1)))
        labels.push_back(label);
    return labels;
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

/// Of a component that is no tree. No node is farther from a third one than from another plus the other's farthest:
/// only those that may by that have the diameter are looked from.
template <typename Scalar>
Scalar diameter_by_bounds(const CurveGraph<Scalar>& graph, const std::vector<int>& component) {
    Scalar diameter = 0;
    std::vector<std::pair<Scalar, int>> open; // how far from a node the farthest may be, the node
    for (const int v : component) open.emplace_back(std::numeric_limits<Scalar>::infinity(), v);
    while (!open.empty()) {
        const int v = std::max_element(open.begin(), open.end())->second;
        const std::vector<Scalar> distance = shortest_paths(graph, v).distance;
        Scalar farthest = 0;
        for (const int w : component) farthest = std::max(farthest, distance[static_cast<std::size_t>(w)]);
        diameter = std::max(diameter, farthest);
        for (auto& [most, w] : open) most = std::min(most, distance[static_cast<std::size_t>(w)] + farthest);
        const Scalar too_little = diameter * (1 - rounding<Scalar>());
        std::erase_if(open, [&](const auto& other) { return other.second == v || other.first < too_little; });
    }
    return diameter;
}

/// The diameter of that component. In a tree, the node farthest from any other is an end of a longest path, so that no
/// more than its two ends are to be looked from: from both, as sums in opposite orders round differently.
template <typename Scalar>
Scalar component_diameter(const CurveGraph<Scalar>& graph, const std::vector<int>& component) {
    std::size_t degrees = 0;
    for (const int v : component) degrees += graph.neighbours[static_cast<std::size_t>(v)].size();
    if (degrees != 2 * (component.size() - 1)) return diameter_by_bounds(graph, component);
    const int end = farthest(graph, component.front()).second;
    const auto [length, other_end] = farthest(graph, end);
    return std::max(length, farthest(graph, other_end).first);
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
