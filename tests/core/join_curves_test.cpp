#include <array>
#include <vector>

#include <skelgen/core/join_curves.hpp>

#include "catch.hpp"

using namespace skelgen;
using namespace skelgen::core;

namespace {

/// Nodes at x, x + 1, ... in a row.
template <typename Scalar>
CurveSkeleton<Scalar> row(Scalar x, int nodes, int first_vertex) {
    CurveSkeleton<Scalar> curve;
    curve.nodes = Points<Scalar>::Zero(nodes, 3);
    for (int i = 0; i < nodes; ++i) {
        curve.nodes(i, 0) = x + static_cast<Scalar>(i);
        curve.radii.push_back(x);
        curve.regions.push_back({first_vertex + i});
        if (i > 0) curve.edges.push_back({i - 1, i});
    }
    return curve;
}

} // namespace

TEMPLATE_TEST_CASE("joined curves have the nodes one after another, and each its own edges", "[core]", float, double) {
    using Scalar = TestType;
    const auto curve = joined<Scalar>({row<Scalar>(1, 3, 0), row<Scalar>(10, 1, 7), row<Scalar>(20, 2, 5)});
    Points<Scalar> nodes = Points<Scalar>::Zero(6, 3);
    nodes.col(0) << 1, 2, 3, 10, 20, 21;
    CHECK(curve.nodes == nodes);
    CHECK(curve.edges == std::vector<std::array<int, 2>>{{0, 1}, {1, 2}, {4, 5}});
    CHECK(curve.radii == std::vector<Scalar>{1, 1, 1, 10, 20, 20});
    CHECK(curve.regions == std::vector<std::vector<int>>{{0}, {1}, {2}, {7}, {5}, {6}}); // the mesh's: not shifted
}

TEST_CASE("one curve joined is itself, none is empty, and empty ones add nothing", "[core]") {
    const auto curve = row<double>(3, 4, 0);
    const auto same = joined<double>({CurveSkeleton<double>(), curve, CurveSkeleton<double>()});
    CHECK(same.nodes == curve.nodes);
    CHECK(same.edges == curve.edges);
    CHECK(same.radii == curve.radii);
    CHECK(same.regions == curve.regions);
    const auto none = joined<double>({});
    CHECK(none.nodes.rows() == 0);
    CHECK((none.edges.empty() && none.radii.empty() && none.regions.empty()));
}

TEST_CASE("radii and regions are joined where every curve has them", "[core]") {
    auto bare = row<double>(3, 2, 0);
    bare.radii.clear();
    const auto without_radii = joined<double>({row<double>(0, 2, 2), bare});
    CHECK(without_radii.radii.empty());
    CHECK(without_radii.regions.size() == 4);
    bare = row<double>(3, 2, 0);
    bare.regions.clear();
    const auto without_regions = joined<double>({bare, row<double>(0, 2, 2)});
    CHECK(without_regions.regions.empty());
    CHECK(without_regions.radii.size() == 4);
}
