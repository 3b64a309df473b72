#include <algorithm>
#include <array>
#include <set>

#include <skelgen/core/geometry.hpp>
#include <skelgen/core/polyline.hpp>
#include <skelgen/curve/branched_curve.hpp>

#include "catch.hpp"
#include "curve/curve_expectations.hpp"
#include "shapes.hpp"

using namespace skelgen;
using namespace skelgen::core;
using namespace skelgen::curve;
using namespace skelgen::test;

namespace {

CurveSkeleton<double> curve_of(const std::vector<Vec3>& nodes, const std::vector<std::array<int, 2>>& edges) {
    CurveSkeleton<double> curve;
    curve.nodes = make_mesh(nodes, {}).vertices;
    curve.edges = edges;
    curve.regions.resize(nodes.size());
    return curve;
}

/// Three arms of two edges each around node 3.
CurveSkeleton<double> y_shape() {
    return curve_of({{0, 0, 2}, {2, 0, 0}, {0, 1, 0}, {0, 0, 0}, {0, 0, 1}, {0, 2, 0}, {1, 0, 0}},
                    {{0, 4}, {3, 4}, {1, 6}, {3, 6}, {2, 3}, {2, 5}});
}
CurveSkeleton<double> ring() {
    return curve_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1}, {1, 2}, {2, 3}, {0, 3}});
}
/// Three ways from node 0 to node 4, one of them without a node between.
CurveSkeleton<double> theta() {
    return curve_of({{0, 0, 0}, {1, 1, 0}, {1, -1, 0}, {1.5, -1, 0}, {2, 0, 0}},
                    {{0, 1}, {1, 4}, {0, 2}, {2, 3}, {3, 4}, {0, 4}});
}
/// A ring at an end of a straight line.
CurveSkeleton<double> lasso() {
    return curve_of({{0, 0, 0}, {1, 1, 0}, {1, -1, 0}, {-1, 0, 0}}, {{0, 1}, {1, 2}, {0, 2}, {0, 3}});
}
CurveSkeleton<double> single_node() { return curve_of({{1, 2, 3}}, {}); }

std::vector<CurveSkeleton<double>> all_curves() { return {y_shape(), ring(), theta(), lasso(), single_node()}; }

using Place = std::array<double, 3>;
Place place(const Points<double>& nodes, int v) { return {nodes(v, 0), nodes(v, 1), nodes(v, 2)}; }

/// The edges by the places of their nodes.
std::multiset<std::array<Place, 2>> edges_by_place(const CurveSkeleton<double>& curve) {
    std::multiset<std::array<Place, 2>> out;
    for (const auto& [a, b] : curve.edges) {
        std::array<Place, 2> edge{place(curve.nodes, a), place(curve.nodes, b)};
        std::sort(edge.begin(), edge.end());
        out.insert(edge);
    }
    return out;
}

/// Do the lines begin and end in their knots?
void check_lines_meet_knots(const BranchedCurve<double>& branched) {
    for (const Branch<double>& branch : branched.branches) {
        REQUIRE(branch.line.rows() >= 2);
        CHECK(point(branch.line, 0) == branched.knots[static_cast<std::size_t>(branch.from)]);
        CHECK(point(branch.line, branch.line.rows() - 1) == branched.knots[static_cast<std::size_t>(branch.to)]);
    }
}

std::vector<double> edge_lengths(const Points<double>& line) {
    std::vector<double> out;
    for (Eigen::Index i = 1; i < line.rows(); ++i) out.push_back((line.row(i) - line.row(i - 1)).norm());
    return out;
}

} // namespace

TEST_CASE("a curve taken apart and joined again has the same edges") {
    for (const CurveSkeleton<double>& curve : all_curves()) {
        const SplitCurve<double> split = split_branches(curve);
        check_lines_meet_knots(split.branched);
        const JoinedCurve<double> joined = join_branches(split.branched);
        CHECK(joined.curve.nodes.rows() == curve.nodes.rows());
        CHECK(edges_by_place(joined.curve) == edges_by_place(curve));
        check_is_curve(joined.curve, 0);
        CHECK(std::is_sorted(joined.curve.edges.begin(), joined.curve.edges.end()));
        CHECK(joined.curve.radii.empty());
        REQUIRE(joined.nodes_of_branch.size() == split.branched.branches.size());
        for (std::size_t b = 0; b < joined.nodes_of_branch.size(); ++b) {
            const Points<double>& line = split.branched.branches[b].line;
            REQUIRE(joined.nodes_of_branch[b].size() == static_cast<std::size_t>(line.rows()));
            for (Eigen::Index i = 0; i < line.rows(); ++i)
                CHECK(point(joined.curve.nodes, joined.nodes_of_branch[b][static_cast<std::size_t>(i)]) ==
                      point(line, i));
        }
    }
    CHECK(join_branches(split_branches(single_node()).branched).curve.nodes == single_node().nodes);
}

TEST_CASE("the knots of a curve are its ends and junctions, and one node of a ring") {
    const auto degrees = [](const CurveSkeleton<double>& curve) {
        std::vector<int> out = split_branches(curve).branched.degrees();
        std::sort(out.begin(), out.end());
        return out;
    };
    CHECK(degrees(y_shape()) == std::vector<int>{1, 1, 1, 3});
    CHECK(degrees(ring()) == std::vector<int>{2});
    CHECK(degrees(theta()) == std::vector<int>{3, 3});
    CHECK(degrees(lasso()) == std::vector<int>{1, 3});
    CHECK(degrees(single_node()) == std::vector<int>{0});
    CHECK(split_branches(ring()).branched.branches[0].line.rows() == 5);
}

TEST_CASE("a node's origin is the number of its knot or of its branch, and its branch knows it") {
    for (const CurveSkeleton<double>& curve : all_curves()) {
        const SplitCurve<double> split = split_branches(curve);
        const CurveGraph<double> graph = curve_graph(curve);
        const auto knots = static_cast<int>(split.branched.knots.size());
        REQUIRE(split.origin_of_node.size() == static_cast<std::size_t>(curve.nodes.rows()));
        for (int v = 0; v < graph.size(); ++v) {
            const int origin = split.origin_of_node[static_cast<std::size_t>(v)];
            REQUIRE(origin >= 0);
            if (graph.degree(v) != 2) REQUIRE(origin < knots);
            if (origin < knots) {
                CHECK(split.branched.knots[static_cast<std::size_t>(origin)] == point(curve.nodes, v));
                continue;
            }
            const Branch<double>& branch = split.branched.branches[static_cast<std::size_t>(origin - knots)];
            CHECK((branch.line.rowwise() - curve.nodes.row(v)).rowwise().norm().minCoeff() == 0);
        }
        for (std::size_t b = 0; b < split.branched.branches.size(); ++b) {
            const Branch<double>& branch = split.branched.branches[b];
            const std::set<int> expected{branch.from, branch.to, knots + static_cast<int>(b)};
            CHECK(branch.origins == std::vector<int>(expected.begin(), expected.end()));
        }
    }
}

TEST_CASE("a curve's branches have evenly spaced points, and the same ends") {
    for (const CurveSkeleton<double>& curve : {y_shape(), theta()}) {
        const BranchedCurve<double> branched = split_branches(curve).branched, fine = resampled(branched, 0.1);
        check_lines_meet_knots(fine);
        REQUIRE(fine.branches.size() == branched.branches.size());
        for (std::size_t b = 0; b < fine.branches.size(); ++b) {
            const auto arc = arc_lengths(branched.branches[b].line);
            const double spacing = arc[arc.size() - 1] / static_cast<double>(fine.branches[b].line.rows() - 1);
            CHECK(spacing == Approx(0.1).epsilon(0.06));
            for (const double length : edge_lengths(fine.branches[b].line)) CHECK(length <= spacing * (1 + 1e-12));
            CHECK(fine.branches[b].origins == branched.branches[b].origins);
        }
    }
    // On straight arms exactly.
    for (const Branch<double>& arm : resampled(split_branches(y_shape()).branched, 0.1).branches)
        for (const double length : edge_lengths(arm.line)) CHECK(length == Approx(0.1));
}

TEST_CASE("however wide the spacing, rings keep three edges and other branches two, and all cycles stay") {
    for (const CurveSkeleton<double>& curve : all_curves()) {
        const BranchedCurve<double> branched = split_branches(curve).branched;
        for (const double spacing : {0.07, 0.5, 100.0}) {
            const BranchedCurve<double> coarse = resampled(branched, spacing);
            for (const Branch<double>& branch : coarse.branches) {
                const int least = branch.from == branch.to ? 4 : 3;
                CHECK(branch.line.rows() >= least);
                if (spacing > 99) CHECK(branch.line.rows() == least);
            }
            const CurveSkeleton<double> joined = join_branches(coarse).curve;
            check_is_curve(joined, 0);
            CHECK(cycles(joined) == cycles(curve));
            CHECK(pieces(joined) == 1);
            CHECK(nodes_of_degree(joined, 1).size() == nodes_of_degree(curve, 1).size());
            CHECK(nodes_of_degree(joined, 3).size() == nodes_of_degree(curve, 3).size());
        }
    }
}

TEST_CASE("knots that no branch has are left out") {
    BranchedCurve<double> branched = split_branches(theta()).branched;
    branched.knots.insert(branched.knots.begin(), Vec3(9, 9, 9));
    for (Branch<double>& branch : branched.branches) ++branch.from, ++branch.to;
    const CurveSkeleton<double> joined = join_branches(branched).curve;
    CHECK(edges_by_place(joined) == edges_by_place(theta()));
    CHECK(joined.nodes.rows() == theta().nodes.rows());
}
