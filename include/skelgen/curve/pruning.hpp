#pragma once

#include <skelgen/core/curve_graph.hpp>
#include <skelgen/core/curve_skeleton.hpp>

namespace skelgen {

/// Lengths of the leaf branches to cut, relative to the largest distance between two nodes (LF20 section 3.1). Two
/// levels: a foot can be as short as a spur on the head, but only once the heel's spur is gone does it continue the
/// leg.
struct PruningOptions {
    double spur = 0.015;  ///< heels and similar artefacts
    double branch = 0.06; ///< fingers, ears, nose
};

namespace detail {

/// From a leaf to the first node that is not of degree 2, both included.
template <typename Scalar>
std::pair<std::vector<int>, Scalar> leaf_branch(const CurveGraph<Scalar>& graph, int leaf) {
    std::vector<int> nodes{leaf};
    Scalar length = 0;
    int previous = -1, v = leaf;
    while (v == leaf || graph.degree(v) == 2) {
        const auto& list = graph.neighbours[static_cast<std::size_t>(v)];
        const auto& next = list[0].first == previous && list.size() > 1 ? list[1] : list[0];
        length += next.second;
        previous = v;
        v = next.first;
        nodes.push_back(v);
    }
    return {nodes, length};
}

/// Without the nodes of `branch` but its last, which inherits their regions.
template <typename Scalar>
CurveSkeleton<Scalar> without_branch(const CurveSkeleton<Scalar>& curve, const std::vector<int>& branch) {
    CurveSkeleton<Scalar> out = curve;
    std::vector<int> index(curve.regions.size(), 0);
    for (std::size_t i = 0; i + 1 < branch.size(); ++i) index[static_cast<std::size_t>(branch[i])] = -1;
    auto& heir = out.regions[static_cast<std::size_t>(branch.back())];
    for (std::size_t i = 0; i + 1 < branch.size(); ++i) {
        const auto& region = curve.regions[static_cast<std::size_t>(branch[i])];
        heir.insert(heir.end(), region.begin(), region.end());
    }
    std::sort(heir.begin(), heir.end());

    int kept = 0;
    for (std::size_t v = 0; v < index.size(); ++v) {
        if (index[v] < 0) continue;
        index[v] = kept;
        out.nodes.row(kept) = curve.nodes.row(static_cast<Eigen::Index>(v));
        if (static_cast<std::size_t>(kept) != v)
            out.regions[static_cast<std::size_t>(kept)] = std::move(out.regions[v]);
        if (!curve.radii.empty()) out.radii[static_cast<std::size_t>(kept)] = curve.radii[v];
        ++kept;
    }
    out.nodes.conservativeResize(kept, 3);
    out.regions.resize(static_cast<std::size_t>(kept));
    if (!curve.radii.empty()) out.radii.resize(static_cast<std::size_t>(kept));
    out.edges.clear();
    for (const auto& [a, b] : curve.edges)
        if (index[static_cast<std::size_t>(a)] >= 0 && index[static_cast<std::size_t>(b)] >= 0)
            out.edges.push_back({index[static_cast<std::size_t>(a)], index[static_cast<std::size_t>(b)]});
    return out;
}

/// Cuts the shortest leaf branch again and again until none is shorter than `length`. Shortest first, because a branch
/// that loses its neighbour grows into the rest of the curve: of five fingers one goes on as the hand.
template <typename Scalar>
CurveSkeleton<Scalar> cut_short_branches(CurveSkeleton<Scalar> curve, Scalar length) {
    while (true) {
        const CurveGraph<Scalar> graph = curve_graph(curve);
        std::vector<int> shortest;
        Scalar shortest_length = length;
        for (int v = 0; v < graph.size(); ++v) {
            if (graph.degree(v) != 1) continue;
            const auto [branch, branch_length] = leaf_branch(graph, v);
            if (graph.degree(branch.back()) < 3 || !(branch_length < shortest_length)) continue;
            shortest = branch;
            shortest_length = branch_length;
        }
        if (shortest.empty()) return curve;
        curve = without_branch(curve, shortest);
    }
}

} // namespace detail

/// Two-level pruning of leaf branches; regions of cut nodes go to the node they hung on. O(k^2 log k).
template <typename Scalar>
[[nodiscard]] CurveSkeleton<Scalar> prune(const CurveSkeleton<Scalar>& curve, const PruningOptions& options = {}) {
    const Scalar unit = curve_diameter(curve_graph(curve));
    CurveSkeleton<Scalar> out = detail::cut_short_branches(curve, static_cast<Scalar>(options.spur) * unit);
    return detail::cut_short_branches(std::move(out), static_cast<Scalar>(options.branch) * unit);
}

} // namespace skelgen
