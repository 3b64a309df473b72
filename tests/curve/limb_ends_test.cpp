#include <skelgen/core/geometry.hpp>
#include <skelgen/curve/limb_ends.hpp>

#include "catch.hpp"
#include "shapes.hpp"

using namespace skelgen;
using namespace skelgen::core;
using namespace skelgen::curve;
using namespace skelgen::test;

namespace {

constexpr double radius = 0.2;

/// A curve along the axis of capsule(radius, 4) up to its upper pole, as contraction and leaf extension leave it; node
/// 0 is the last before that pole.
CurveSkeleton<double> curve_to_pole(const Mesh& mesh, const Vec3& last, double last_radius) {
    CurveSkeleton<double> curve;
    curve.nodes.resize(5, 3);
    curve.nodes << last.transpose(), 0, 0, 4.2, 0, 0, 3, 0, 0, 2, 0, 0, -0.2;
    curve.edges = {{0, 1}, {0, 2}, {2, 3}, {3, 4}};
    curve.radii = {last_radius, 0, radius, radius, 0};
    curve.regions.resize(5);
    for (int v = 0; v < mesh.vertices.rows(); ++v) {
        const double z = mesh.vertices(v, 2);
        curve.regions[z > 4.19 ? 1 : z > 3.5 ? 0 : z > 2.5 ? 2 : z > -0.19 ? 3 : 4].push_back(v);
    }
    return curve;
}

/// Of the regions above: how far their vertices are from `place` on average.
double mean_distance(const Mesh& mesh, const std::vector<int>& region, const Vec3& place) {
    double sum = 0;
    for (const int v : region) sum += (mesh.vertices.row(v).transpose() - place).norm();
    return sum / static_cast<double>(region.size());
}

} // namespace

TEST_CASE("a node that lies outside beside a tip moves inward along the curve, half the way") {
    const Mesh mesh = capsule(radius, 4);
    const Vec3 outside(0.1, 0, 4.2), halfway(0.05, 0, 3.6);
    const CurveSkeleton<double> curve = curve_to_pole(mesh, outside, 0.1);
    REQUIRE(winding_number(mesh, outside) < 0.5);
    const CurveSkeleton<double> placed = place_limb_ends(curve, mesh);
    CHECK((placed.nodes.row(0).transpose() - halfway).norm() < 1e-12);
    CHECK(placed.nodes.bottomRows(4) == curve.nodes.bottomRows(4));
    CHECK(placed.radii[0] == Approx(mean_distance(mesh, curve.regions[0], halfway)));
    CHECK(placed.edges == curve.edges);
    CHECK(placed.regions == curve.regions);
}

TEST_CASE("a node far outside moves half the way again, until it is inside") {
    const Mesh mesh = capsule(radius, 4);
    const CurveSkeleton<double> curve = curve_to_pole(mesh, Vec3(0.7, 0, 4), 0.1);
    const CurveSkeleton<double> placed = place_limb_ends(curve, mesh);
    CHECK((placed.nodes.row(0).transpose() - Vec3(0.175, 0, 3.25)).norm() < 1e-12);
}

TEST_CASE("a node without a radius beside a tip lies on the surface and moves inward") {
    const Mesh mesh = capsule(radius, 4);
    const CurveSkeleton<double> curve = curve_to_pole(mesh, Vec3(0, 0, 4.19), 0);
    const CurveSkeleton<double> placed = place_limb_ends(curve, mesh);
    CHECK((placed.nodes.row(0).transpose() - Vec3(0, 0, 3.595)).norm() < 1e-12);
    CHECK(placed.radii[0] > 0);
}

TEST_CASE("a node whose only vertex has become the tip moves inward too, and reaches to the nearest surface") {
    const Mesh mesh = capsule(radius, 4, 64, 80);
    CurveSkeleton<double> curve = curve_to_pole(mesh, Vec3(0, 0, 4.25), 0);
    curve.regions[2].insert(curve.regions[2].end(), curve.regions[0].begin(), curve.regions[0].end());
    curve.regions[0].clear();
    const CurveSkeleton<double> placed = place_limb_ends(curve, mesh);
    CHECK((placed.nodes.row(0).transpose() - Vec3(0, 0, 3.625)).norm() < 1e-12);
    CHECK(placed.radii[0] == Approx(radius).epsilon(0.02));
    CHECK(placed.radii[1] == placed.radii[0]);
}

TEST_CASE("tips take over the radius beside them; what lies inside stays where it is") {
    const Mesh mesh = capsule(radius, 4);
    const CurveSkeleton<double> curve = curve_to_pole(mesh, Vec3(0.01, 0, 4), 0.15);
    const CurveSkeleton<double> placed = place_limb_ends(curve, mesh);
    CHECK(placed.nodes == curve.nodes);
    CHECK(placed.radii == std::vector<double>{0.15, 0.15, radius, radius, radius});
}

TEST_CASE("limb ends are placed in float as in double") {
    const Mesh mesh = capsule(radius, 4);
    const CurveSkeleton<double> curve = curve_to_pole(mesh, Vec3(0.7, 0, 4), 0.1),
                                expected = place_limb_ends(curve, mesh);
    const CurveSkeleton<float> rounded{
        curve.nodes.cast<float>(), curve.edges, curve.regions, {curve.radii.begin(), curve.radii.end()}};
    const CurveSkeleton<float> placed =
        place_limb_ends(rounded, TriangleMesh<float>{mesh.vertices.cast<float>(), mesh.faces});
    CHECK((placed.nodes.cast<double>() - expected.nodes).cwiseAbs().maxCoeff() < 1e-6);
    for (std::size_t k = 0; k < placed.radii.size(); ++k)
        CHECK(placed.radii[k] == Approx(expected.radii[k]).epsilon(1e-5));
}
