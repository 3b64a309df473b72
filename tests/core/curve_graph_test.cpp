#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <skelgen/core/curve_graph.hpp>
#include <skelgen/core/join_curves.hpp>

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

TEST_CASE("a search for shortest paths ends where it is told to") {
    const auto paths = shortest_paths(curve_graph(square_with_tail()), 4, 3.0);
    CHECK(paths.distance[0] == 2);
    CHECK(paths.distance[1] == 3);
    CHECK(std::isinf(paths.distance[2]));
    CHECK(paths.predecessor[2] == -1);
}

TEST_CASE("the diameter of a curve is its longest shortest path") {
    CHECK(curve_diameter(curve_graph(square_with_tail())) == Approx(4));
    CHECK(curve_diameter(CurveGraph<double>{}) == 0);
}

namespace {

/// A curve of `trees` trees whose nodes hang on random ones before them, at random places.
template <typename Scalar>
CurveSkeleton<Scalar> random_forest(int nodes, int trees, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<Scalar> coordinate(-1, 1);
    CurveSkeleton<Scalar> curve;
    curve.nodes.resize(nodes, 3);
    for (Eigen::Index i = 0; i < curve.nodes.size(); ++i) curve.nodes.data()[i] = coordinate(random);
    for (int v = trees; v < nodes; ++v) {
        const int reach = v % 3 == 0 ? v : std::min(v, 2 * trees); // some bushy, some long
        curve.edges.push_back({v - 1 - static_cast<int>(random() % static_cast<unsigned>(reach)), v});
    }
    return curve;
}

/// The longest of all shortest paths.
template <typename Scalar>
Scalar longest_of_all(const CurveGraph<Scalar>& graph) {
    Scalar longest = 0;
    for (int v = 0; v < graph.size(); ++v)
        for (const Scalar d : shortest_paths(graph, v).distance)
            if (std::isfinite(d)) longest = std::max(longest, d);
    return longest;
}

} // namespace

TEMPLATE_TEST_CASE("the diameter is the longest of all shortest paths, to the last bit", "[core]", float, double) {
    for (unsigned seed = 0; seed < 20; ++seed) {
        CAPTURE(seed);
        CurveSkeleton<TestType> curve = random_forest<TestType>(60, 1 + static_cast<int>(seed % 4), seed);
        REQUIRE(cycle_count(curve) == 0);
        CHECK(curve_diameter(curve_graph(curve)) == longest_of_all(curve_graph(curve)));
        for (int v = 0; v < 4; ++v) curve.edges.push_back({v, 59 - v}); // more than there are trees to be joined
        REQUIRE(cycle_count(curve) > 0);
        CHECK(curve_diameter(curve_graph(curve)) == longest_of_all(curve_graph(curve)));
    }
}

TEST_CASE("a point and a curve without edges have no diameter, and lengths of zero do no harm") {
    CurveSkeleton<double> curve;
    curve.nodes = Points<double>::Zero(3, 3);
    CHECK(curve_diameter(curve_graph(curve)) == 0);
    curve.edges = {{0, 1}, {1, 2}};
    CHECK(curve_diameter(curve_graph(curve)) == 0);
    curve.nodes(2, 0) = 1;
    CHECK(curve_diameter(curve_graph(curve)) == 1);
}

TEST_CASE("ends, components and cycles of a curve in several pieces") {
    CurveSkeleton<double> curve = square_with_tail(); // and a node on its own
    CHECK(end_count(curve) == 1);
    CHECK(nodes_of_degree(curve, 0) == std::vector<int>{5});
    CHECK(nodes_of_degree(curve, 1) == std::vector<int>{4});
    CHECK(nodes_of_degree(curve, 2) == std::vector<int>{1, 2, 3});
    CHECK(nodes_of_degree(curve, 4).empty());
    CHECK(component_count(curve) == 2);
    CHECK(cycle_count(curve) == 1);
    curve.edges.push_back({0, 2});
    CHECK(cycle_count(curve) == 2);
    curve.edges.push_back({4, 5});
    CHECK(component_count(curve) == 1);
    CHECK(cycle_count(curve) == 2);

    const CurveSkeleton<double> pair = joined<double>({square_with_tail(), square_with_tail()});
    CHECK(component_count(pair) == 4);
    CHECK(cycle_count(pair) == 2);
    CHECK(end_count(pair) == 2);

    const CurveSkeleton<double> none;
    CHECK(component_count(none) == 0);
    CHECK(cycle_count(none) == 0);
    CHECK(end_count(none) == 0);
}

TEST_CASE("each node belongs to the source nearest along the curve, to the lowest label among equals") {
    const CurveGraph<double> graph = curve_graph(square_with_tail());
    CHECK(nearest_source<double>(graph, {{0, 0, 4}, {0, 1, 2}}) == std::vector<int>{0, 1, 1, 1, 0, -1});
    CHECK(nearest_source<double>(graph, {{0, 0, 1}, {0, 1, 3}}) == std::vector<int>{0, 0, 0, 1, 0, -1});
    CHECK(nearest_source<double>(graph, {{0, 1, 3}, {0, 0, 1}}) == std::vector<int>{0, 0, 0, 1, 0, -1});
    CHECK(nearest_source<double>(graph, {{0, 7, 1}, {0, 3, 3}}) == std::vector<int>{3, 7, 3, 3, 3, -1});
    CHECK(nearest_source<double>(graph, {}) == std::vector<int>(6, -1));
}

TEST_CASE("a source's own distance counts, and one may begin in several nodes") {
    const CurveGraph<double> graph = curve_graph(square_with_tail());
    CHECK(nearest_source<double>(graph, {{0.5, 0, 1}, {0, 1, 3}}) == std::vector<int>{1, 0, 1, 1, 1, -1});
    CHECK(nearest_source<double>(graph, {{9, 0, 1}, {0, 1, 3}}) == std::vector<int>{1, 1, 1, 1, 1, -1});
    CHECK(nearest_source<double>(graph, {{-0.5, 1, 1}, {0, 0, 3}}) == std::vector<int>{1, 1, 1, 0, 1, -1});
    CHECK(nearest_source<double>(graph, {{0, 2, 5}, {0, 2, 4}, {1, 1, 2}}) == std::vector<int>{2, 1, 1, 1, 2, 2});
    // In one node: the nearer one, of equals the lowest label.
    CHECK(nearest_source<double>(graph, {{2, 0, 4}, {1, 1, 4}}) == std::vector<int>{1, 1, 1, 1, 1, -1});
    CHECK(nearest_source<double>(graph, {{1, 4, 4}, {1, 3, 4}}) == std::vector<int>{3, 3, 3, 3, 3, -1});
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
    CHECK(cycle_count(ring) == 1);
}

namespace {

using Edges = std::vector<std::array<int, 2>>;
using Branches = std::vector<std::vector<int>>;

/// All branches of a graph of that many nodes.
Branches branches_of(int count, const Edges& edges) {
    CurveSkeleton<double> curve;
    curve.nodes = Points<double>::Zero(count, 3);
    for (int v = 0; v < count; ++v) curve.nodes(v, 0) = v;
    curve.edges = edges;
    return branches(curve_graph(curve));
}

} // namespace

TEST_CASE("a tree falls into branches from ends and junctions to the next ones, each once") {
    CHECK(branches_of(6, {{0, 3}, {1, 3}, {2, 3}, {2, 5}, {4, 5}}) == Branches{{0, 3}, {1, 3}, {3, 2, 5, 4}});
    CHECK(branches_of(4, {{0, 3}, {2, 3}, {1, 2}}) == Branches{{0, 3, 2, 1}});
    CHECK(branches_of(2, {{0, 1}}) == Branches{{0, 1}});
    CHECK(branches_of(5, {{0, 4}, {1, 4}, {2, 4}, {3, 4}}) == Branches{{0, 4}, {1, 4}, {2, 4}, {3, 4}});
}

TEST_CASE("a ring is a branch from its lowest node back to it, also beside others") {
    CHECK(branches_of(4, {{0, 1}, {1, 2}, {2, 3}, {0, 3}}) == Branches{{0, 1, 2, 3, 0}});
    CHECK(branches_of(8, {{1, 5}, {2, 5}, {1, 2}, {0, 3}, {4, 6}, {6, 7}, {4, 7}}) ==
          Branches{{0, 3}, {1, 2, 5, 1}, {4, 6, 7, 4}});
}

TEST_CASE("two junctions may be joined by several branches") {
    CHECK(branches_of(5, {{0, 1}, {1, 4}, {0, 2}, {2, 4}, {0, 3}, {3, 4}}) ==
          Branches{{0, 1, 4}, {0, 2, 4}, {0, 3, 4}});
    CHECK(branches_of(4, {{0, 3}, {0, 1}, {1, 3}, {0, 2}, {2, 3}}) == Branches{{0, 1, 3}, {0, 2, 3}, {0, 3}});
}

TEST_CASE("a loop at a junction is one branch, and a node on its own is none") {
    CHECK(branches(curve_graph(square_with_tail())) == Branches{{0, 1, 2, 3, 0}, {0, 4}});
    CHECK(branches_of(5, {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {3, 4}, {0, 4}}) == Branches{{0, 1, 2, 0}, {0, 3, 4, 0}});
    CHECK(branches_of(1, {}).empty());
    CHECK(branches(CurveGraph<double>{}).empty());
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
