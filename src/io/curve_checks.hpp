#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <skelgen/core/curve_skeleton.hpp>
#include <skelgen/core/error.hpp>

namespace skelgen::io::detail {

/// \throws Error `code` when a curve skeleton has no nodes, its parts contradict each other or a number is not finite.
template <typename Scalar>
void check_curve(const CurveSkeleton<Scalar>& curve, ErrorCode code) {
    const auto require = [code](bool condition, const char* broken) {
        if (!condition)
            throw Error(code, std::string("the curve skeleton is unsound: ") + broken + "; compute it again");
    };
    const auto nodes = static_cast<std::size_t>(curve.nodes.rows());
    const auto is_node = [nodes](int i) { return i >= 0 && static_cast<std::size_t>(i) < nodes; };
    require(nodes > 0, "there are no nodes");
    require(curve.nodes.allFinite(), "a node's coordinate is not a number or infinite");
    std::vector<std::array<int, 2>> edges = curve.edges;
    for (auto& edge : edges) {
        require(is_node(edge[0]) && is_node(edge[1]), "an edge names a node that does not exist");
        require(edge[0] != edge[1], "an edge goes from a node to itself");
        std::sort(edge.begin(), edge.end());
    }
    std::sort(edges.begin(), edges.end());
    require(std::adjacent_find(edges.begin(), edges.end()) == edges.end(), "an edge is there twice");
    require(curve.radii.empty() || curve.radii.size() == nodes, "there is not one radius for each node");
    require(curve.regions.empty() || curve.regions.size() == nodes, "there is not one region for each node");
    require(std::all_of(curve.radii.begin(), curve.radii.end(), [](Scalar r) { return std::isfinite(r) && r >= 0; }),
            "a radius is negative, infinite or not a number");
}

} // namespace skelgen::io::detail
