#include <algorithm>

#include <skelgen/curve/leaf_extension.hpp>

#include "catch.hpp"
#include "curve/curve_expectations.hpp"
#include "curve/throws.hpp"
#include "curve/unit_body.hpp"
#include "shapes.hpp"

using namespace skelgen;
using namespace skelgen::core;
using namespace skelgen::curve;
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
        const int nearest = nearest_node(curve, Vec3(mesh.vertices.row(v)));
        curve.regions[static_cast<std::size_t>(nearest)].push_back(v);
    }
    return curve;
}

} // namespace

TEST_CASE("each leaf is extended to the end of its limb") {
    const Mesh mesh = capsule(0.2, 4);
    const CurveSkeleton<double> curve = short_curve(mesh), extended = extend_leaves(curve, body_of(mesh));
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
    const CurveSkeleton<double> extended = extend_leaves(curve, body_of(mesh));
    const std::vector<int> leaves = nodes_of_degree(extended, 1);
    REQUIRE(leaves.size() == 2);
    CHECK((extended.nodes.row(leaves[0]) - Vec3(0, 0, -0.2).transpose()).norm() < 0.05);
}

TEST_CASE("a leaf that is as far out as its surface stays as it is") {
    const Mesh mesh = capsule(0.2, 4);
    CurveSkeleton<double> curve = short_curve(mesh);
    curve.nodes.row(0) << 0, 0, -0.3;
    curve.nodes.row(8) << 0, 0, 4.3;
    const CurveSkeleton<double> extended = extend_leaves(curve, body_of(mesh));
    CHECK(extended.nodes == curve.nodes);
    CHECK(extended.edges == curve.edges);
}

TEST_CASE("leaves are extended in float as in double") {
    const Mesh mesh = capsule(0.2, 4);
    const CurveSkeleton<double> curve = short_curve(mesh), expected = extend_leaves(curve, body_of(mesh));
    const CurveSkeleton<float> rounded{curve.nodes.cast<float>(), curve.edges, curve.regions, {}};
    const Body<float> body = body_of(TriangleMesh<float>{mesh.vertices.cast<float>(), mesh.faces});
    const CurveSkeleton<float> extended = extend_leaves(rounded, body);
    CHECK(extended.edges == expected.edges);
    CHECK(extended.regions == expected.regions);
    CHECK((extended.nodes.cast<double>() - expected.nodes).cwiseAbs().maxCoeff() < 1e-6);
    CHECK(extended.radii.empty());
}

TEST_CASE("a curve of two nodes is extended at both, looking from the other one") {
    const Mesh mesh = capsule(0.2, 4);
    CurveSkeleton<double> curve;
    curve.nodes.resize(2, 3);
    curve.nodes << 0, 0, 1, 0, 0, 3;
    curve.edges = {{0, 1}};
    curve.regions.resize(2);
    for (int v = 0; v < mesh.vertices.rows(); ++v) curve.regions[mesh.vertices(v, 2) > 2].push_back(v);
    const CurveSkeleton<double> extended = extend_leaves(curve, body_of(mesh));
    REQUIRE(extended.nodes.rows() == 4);
    CHECK((extended.nodes.row(2) - Vec3(0, 0, -0.2).transpose()).norm() < 0.05);
    CHECK((extended.nodes.row(3) - Vec3(0, 0, 4.2).transpose()).norm() < 0.05);
}

TEST_CASE("leaf extension refuses an anchor that makes no sense") {
    const Mesh mesh = capsule(0.2, 4);
    LeafExtensionOptions options;
    options.anchor = -0.1;
    const auto extend = [&] { static_cast<void>(extend_leaves(short_curve(mesh), body_of(mesh), options)); };
    CHECK(throws(ErrorCode::usage, extend));
}
