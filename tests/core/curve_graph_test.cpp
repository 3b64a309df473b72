#include <cmath>
#include <limits>

#include <skelgen/core/curve_graph.hpp>

#include "catch.hpp"

using namespace skelgen;
using namespace skelgen::core;

namespace {

/// A square of side 1 (nodes 0 to 3) with a tail of length 2 at node 0 (node 4), and a node on its own (5).
CurveSkeleton<double> square_with_tail() {
    CurveSkeleton<double> curve;
    curve.nodes.resize(6, 3);
    curve.nodes << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, -2, 0, 0, 9, 9, 9;
    curve.edges = {{0, 1}, {1, 2}, {2, 3}, {0, 3}, {0, 4}};
    return curve;
}

} // namespace

TEST_CASE("a curve's graph has the edges in both directions, with their lengths, in ascending order") {
    const CurveGraph<double> graph = curve_graph(square_with_tail());
    CHECK(graph.size() == 6);
    CHECK(graph.degree(0) == 3);
    CHECK(graph.degree(4) == 1);
    CHECK(graph.degree(5) == 0);
    const std::vector<std::pair<int, double>> expected{{1, 1.0}, {3, 1.0}, {4, 2.0}};
    CHECK(graph.neighbours[0] == expected);
}

TEST_CASE("shortest paths go the short way round and do not reach what is not connected") {
    const auto paths = shortest_paths(curve_graph(square_with_tail()), 4);
    CHECK(paths.distance[4] == 0);
    CHECK(paths.distance[0] == 2);
    CHECK(paths.distance[1] == 3);
    CHECK(paths.distance[3] == 3);
    CHECK(paths.distance[2] == 4);
    CHECK(std::isinf(paths.distance[5]));
    CHECK(paths.path_to(3) == std::vector<int>{4, 0, 3});
    CHECK(paths.path_to(4) == std::vector<int>{4});
}

TEST_CASE("the diameter of a curve is its longest shortest path") {
    CHECK(curve_diameter(curve_graph(square_with_tail())) == Approx(4));
    CHECK(curve_diameter(CurveGraph<double>{}) == 0);
}

TEST_CASE("each node belongs to the source nearest along the curve, to the first one among equals") {
    const CurveGraph<double> graph = curve_graph(square_with_tail());
    CHECK(nearest_source(graph, {4, 2}) == std::vector<int>{0, 1, 1, 1, 0, -1});
    CHECK(nearest_source(graph, {1, 3}) == std::vector<int>{0, 0, 0, 1, 0, -1});
    CHECK(nearest_source(graph, {}) == std::vector<int>(6, -1));
}

TEST_CASE("a branch goes on to the next node that is not of degree 2") {
    const CurveGraph<double> graph = curve_graph(square_with_tail());
    CHECK(branch(graph, 4, 0) == std::vector<int>{4, 0});
    CHECK(branch(graph, 0, 4) == std::vector<int>{0, 4});
    CHECK(branch(graph, 0, 1) == std::vector<int>{0, 1, 2, 3, 0});
    CHECK(branch(graph, 2, 3) == std::vector<int>{2, 3, 0});
}

TEST_CASE("a branch around a ring without junctions ends where it began") {
    CurveSkeleton<double> ring = square_with_tail();
    ring.edges.pop_back();
    CHECK(branch(curve_graph(ring), 1, 2) == std::vector<int>{1, 2, 3, 0, 1});
    CHECK(cycle_count(ring) == 4 - 6 + 1);
}

TEST_CASE("the length of a path and the node nearest to a point, in both precisions") {
    const CurveSkeleton<double> curve = square_with_tail();
    CHECK(path_length(curve, {4, 0, 1, 2}) == 4);
    CHECK(path_length(curve, {3}) == 0);
    CHECK(nearest_node(curve, Vector3<double>(0.9, 0.2, 0.5)) == 1);
    CurveSkeleton<float> rounded;
    rounded.nodes = curve.nodes.cast<float>();
    rounded.edges = curve.edges;
    CHECK(path_length(rounded, {4, 0, 1, 2}) == 4.0f);
    CHECK(nearest_node(rounded, Vector3<float>(0.9f, 0.2f, 0.5f)) == 1);
    CHECK(curve_diameter(curve_graph(rounded)) == Approx(4.0f));
}
