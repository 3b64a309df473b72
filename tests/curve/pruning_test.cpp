#include <cmath>

#include <skelgen/curve/pruning.hpp>

#include "catch.hpp"
#include "curve/curve_expectations.hpp"
#include "curve/throws.hpp"

using namespace skelgen;
using namespace skelgen::core;
using namespace skelgen::curve;
using namespace skelgen::test;

namespace {

/// Builds a curve from polylines: `to(parent, x, y)` adds a node with an edge to `parent` and a region of one vertex.
class Drawing {
public:
    Drawing() { add(0, 0); }

    int to(int parent, double x, double y) {
        const int node = add(x, y);
        curve_.edges.push_back({parent, node});
        return node;
    }
    [[nodiscard]] const CurveSkeleton<double>& curve() const { return curve_; }

private:
    int add(double x, double y) {
        const auto node = static_cast<int>(curve_.nodes.rows());
        curve_.nodes.conservativeResize(node + 1, 3);
        curve_.nodes.row(node) << x, y, 0;
        curve_.regions.push_back({node});
        curve_.radii.push_back(node);
        return node;
    }
    CurveSkeleton<double> curve_;
};

} // namespace

TEST_CASE("a path has nothing to prune") {
    Drawing path;
    path.to(path.to(0, 0.001, 0), 1, 0);
    const CurveSkeleton<double> pruned = prune(path.curve());
    CHECK(pruned.nodes == path.curve().nodes);
    CHECK(pruned.edges == path.curve().edges);
}

TEST_CASE("branches shorter than 6 % of the longest distance are cut, longer ones stay") {
    Drawing comb; // a spine of length 1 with a short and a long tooth
    const int a = comb.to(0, 0.3, 0), b = comb.to(a, 0.7, 0);
    comb.to(b, 1, 0);
    comb.to(a, 0.3, 0.05);
    comb.to(b, 0.7, 0.07);
    const CurveSkeleton<double> pruned = prune(comb.curve());
    CHECK(nodes_of_degree(pruned, 1).size() == 3);
    CHECK(nodes_of_degree(pruned, 3).size() == 1);
    check_is_curve(pruned, comb.curve().nodes.rows());
}

TEST_CASE("the surface of a cut branch goes to the node it hung on; radii keep their nodes") {
    Drawing comb;
    const int a = comb.to(0, 0.5, 0);
    const int first = comb.to(a, 0.5, 0.02), second = comb.to(first, 0.5, 0.04), end = comb.to(a, 1, 0);
    const CurveSkeleton<double> pruned = prune(comb.curve());
    REQUIRE(pruned.nodes.rows() == 3);
    CHECK(pruned.regions[1] == std::vector<int>{a, first, second});
    CHECK(pruned.radii[2] == end);
    CHECK(pruned.nodes.row(2) == comb.curve().nodes.row(end));
}

TEST_CASE("a foot survives although it is as short as a branch: its heel is cut first and the foot continues the leg") {
    Drawing leg;
    const int ankle = leg.to(0, 0, -1);
    const int toe = leg.to(ankle, 0.05, -1); // the foot: 5 %, below the branch level
    leg.to(ankle, -0.01, -1);                // the heel: 1 %, below the spur level
    const CurveSkeleton<double> pruned = prune(leg.curve());
    const std::vector<int> leaves = nodes_of_degree(pruned, 1);
    REQUIRE(leaves.size() == 2);
    CHECK(pruned.nodes.row(leaves[1]) == leg.curve().nodes.row(toe));
    CHECK(nodes_of_degree(pruned, 3).empty());
}

TEST_CASE("of five fingers the longest goes on as the hand") {
    Drawing arm;
    const int wrist = arm.to(0, 1, 0);
    int longest = -1;
    for (int finger = 0; finger < 5; ++finger) {
        const double angle = 0.3 * (finger - 2), length = finger == 2 ? 0.055 : 0.035 + 0.004 * finger;
        const int middle = arm.to(wrist, 1 + length / 2 * std::cos(angle), length / 2 * std::sin(angle));
        const int tip = arm.to(middle, 1 + length * std::cos(angle), length * std::sin(angle));
        if (finger == 2) longest = tip;
    }
    const CurveSkeleton<double> pruned = prune(arm.curve());
    const std::vector<int> leaves = nodes_of_degree(pruned, 1);
    REQUIRE(leaves.size() == 2);
    CHECK(pruned.nodes.row(leaves[1]) == arm.curve().nodes.row(longest));
    CHECK(nodes_of_degree(pruned, 2).size() == 2); // the wrist and the middle of the finger
    check_is_curve(pruned, arm.curve().nodes.rows());
}

TEST_CASE("cycles are not pruned, what hangs on them is") {
    CurveSkeleton<double> ring;
    ring.nodes.resize(5, 3);
    ring.nodes << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, -0.05, 0, 0;
    ring.edges = {{0, 1}, {1, 2}, {2, 3}, {0, 3}, {0, 4}};
    ring.regions = {{0}, {1}, {2}, {3}, {4}};
    const CurveSkeleton<double> pruned = prune(ring);
    CHECK(pruned.nodes.rows() == 4);
    CHECK(cycles(pruned) == 1);
}

TEST_CASE("pruning cuts the same branches in float as in double") {
    Drawing comb;
    const int a = comb.to(0, 0.3, 0), b = comb.to(a, 0.7, 0);
    comb.to(b, 1, 0);
    comb.to(a, 0.3, 0.05);
    comb.to(b, 0.7, 0.07);
    const CurveSkeleton<double> expected = prune(comb.curve());
    const CurveSkeleton<float> rounded{comb.curve().nodes.cast<float>(), comb.curve().edges, comb.curve().regions, {}};
    const CurveSkeleton<float> pruned = prune(rounded);
    CHECK(pruned.edges == expected.edges);
    CHECK(pruned.regions == expected.regions);
}

TEST_CASE("pruning refuses lengths that make no sense") {
    CurveSkeleton<double> none;
    for (const PruningOptions& options : {PruningOptions{-0.1, 0.06}, PruningOptions{0.015, std::nan("")}})
        CHECK(throws(ErrorCode::usage, [&] { static_cast<void>(prune(none, options)); }));
    CHECK(prune(none).nodes.rows() == 0);
}
