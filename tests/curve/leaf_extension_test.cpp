#include <algorithm>

#include <skelgen/core/geodesics.hpp>
#include <skelgen/curve/leaf_extension.hpp>

#include "catch.hpp"
#include "curve/curve_expectations.hpp"
#include "shapes.hpp"

using namespace skelgen;
using namespace skelgen::test;

namespace {

/// The curve of a capsule from z = 0 to 4 as contraction leaves it: too short at both ends, and a little off the axis.
CurveSkeleton<double> short_curve(const Mesh& mesh) {
    constexpr int count = 9;
    CurveSkeleton<double> curve;
    curve.nodes.resize(count, 3);
    curve.regions.resize(count);
    curve.radii.assign(count, 0.2);
    for (int k = 0; k < count; ++k) {
        curve.nodes.row(k) << 0.01, -0.02, 0.4 * (k + 1);
        if (k > 0) curve.edges.push_back({k - 1, k});
    }
    for (int v = 0; v < mesh.vertices.rows(); ++v) {
        Eigen::Index nearest = 0;
        (curve.nodes.rowwise() - mesh.vertices.row(v)).rowwise().squaredNorm().minCoeff(&nearest);
        curve.regions[static_cast<std::size_t>(nearest)].push_back(v);
    }
    return curve;
}

} // namespace

TEST_CASE("each leaf is extended to the end of its limb") {
    const Mesh mesh = capsule(0.2, 4);
    const CurveSkeleton<double> curve = short_curve(mesh), extended = extend_leaves(curve, mesh, surface_graph(mesh));
    check_is_curve(extended, mesh.vertices.rows());
    REQUIRE(extended.nodes.rows() == curve.nodes.rows() + 2);
    CHECK(extended.nodes.topRows(curve.nodes.rows()) == curve.nodes);
    const std::vector<int> leaves = nodes_of_degree(extended, 1);
    REQUIRE(leaves.size() == 2);
    CHECK((extended.nodes.row(leaves[0]) - Vec3(0, 0, -0.2).transpose()).norm() < 0.05);
    CHECK((extended.nodes.row(leaves[1]) - Vec3(0, 0, 4.2).transpose()).norm() < 0.05);
    CHECK(extended.radii.size() == extended.regions.size());
}

TEST_CASE("a stray vertex of another limb in the leaf's region does not count") {
    const Mesh mesh = capsule(0.2, 4);
    CurveSkeleton<double> curve = short_curve(mesh);
    auto &first = curve.regions.front(), &last = curve.regions.back();
    const int stray = last.back(); // from the other end of the capsule
    last.pop_back();
    first.insert(std::lower_bound(first.begin(), first.end(), stray), stray);
    const CurveSkeleton<double> extended = extend_leaves(curve, mesh, surface_graph(mesh));
    const std::vector<int> leaves = nodes_of_degree(extended, 1);
    REQUIRE(leaves.size() == 2);
    CHECK((extended.nodes.row(leaves[0]) - Vec3(0, 0, -0.2).transpose()).norm() < 0.05);
}

TEST_CASE("a leaf that is as far out as its surface stays as it is") {
    const Mesh mesh = capsule(0.2, 4);
    CurveSkeleton<double> curve = short_curve(mesh);
    curve.nodes.row(0) << 0, 0, -0.3;
    curve.nodes.row(8) << 0, 0, 4.3;
    const CurveSkeleton<double> extended = extend_leaves(curve, mesh, surface_graph(mesh));
    CHECK(extended.nodes == curve.nodes);
    CHECK(extended.edges == curve.edges);
}
