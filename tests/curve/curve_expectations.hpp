#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <skelgen/core/curve_graph.hpp>
#include <skelgen/core/curve_skeleton.hpp>

#include "catch.hpp"

namespace skelgen::test {

using core::nodes_of_degree;

/// Number of connected pieces of a curve.
template <typename Scalar>
int pieces(const CurveSkeleton<Scalar>& curve) {
    const core::CurveGraph<Scalar> graph = core::curve_graph(curve);
    std::vector<bool> reached(static_cast<std::size_t>(graph.size()), false);
    int count = 0;
    for (int start = 0; start < graph.size(); ++start) {
        if (reached[static_cast<std::size_t>(start)]) continue;
        ++count;
        const std::vector<Scalar> distance = core::shortest_paths(graph, start).distance;
        for (std::size_t v = 0; v < distance.size(); ++v)
            if (std::isfinite(distance[v])) reached[v] = true;
    }
    return count;
}

/// Number of independent cycles of a curve.
template <typename Scalar>
int cycles(const CurveSkeleton<Scalar>& curve) {
    return static_cast<int>(curve.edges.size()) - static_cast<int>(curve.nodes.rows()) + pieces(curve);
}

/// Is `curve` well-formed: edges between existing nodes, first < second, each once, and each of `vertices` mesh
/// vertices in the region of exactly one node?
template <typename Scalar>
void check_is_curve(const CurveSkeleton<Scalar>& curve, Eigen::Index vertices) {
    CHECK(curve.nodes.allFinite());
    CHECK(curve.regions.size() == static_cast<std::size_t>(curve.nodes.rows()));
    std::vector<std::array<int, 2>> edges = curve.edges;
    CHECK(std::all_of(edges.begin(), edges.end(),
                      [&](const auto& e) { return 0 <= e[0] && e[0] < e[1] && e[1] < curve.nodes.rows(); }));
    std::sort(edges.begin(), edges.end());
    CHECK(std::adjacent_find(edges.begin(), edges.end()) == edges.end());

    std::vector<int> count(static_cast<std::size_t>(vertices), 0);
    for (const std::vector<int>& region : curve.regions)
        for (const int v : region) {
            REQUIRE(v >= 0);
            REQUIRE(v < vertices);
            ++count[static_cast<std::size_t>(v)];
        }
    CHECK(std::all_of(count.begin(), count.end(), [](int n) { return n == 1; }));
}

} // namespace skelgen::test
