#include <algorithm>
#include <cmath>

#include <skelgen/core/geodesics.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/curve/extract_curve.hpp>
#include <skelgen/curve/proxy.hpp>

#include "catch.hpp"
#include "curve/curve_expectations.hpp"
#include "mesh_changes.hpp"
#include "shapes.hpp"

using namespace skelgen;
using namespace skelgen::test;

namespace {

/// `mesh` scaled to unit area, as the pipeline does.
Mesh with_unit_area(Mesh mesh) {
    mesh.vertices /= std::sqrt(surface_area(mesh));
    return mesh;
}

CurveSkeleton<double> curve_of(const Mesh& mesh) { return extract_curve(mesh, surface_graph(mesh), build_proxy(mesh)); }

/// From the Y's three ends down to its one junction.
void check_is_y(const CurveSkeleton<double>& curve, double scale) {
    CHECK(pieces(curve) == 1);
    CHECK(cycles(curve) == 0);
    const std::vector<int> leaves = nodes_of_degree(curve, 1), junctions = nodes_of_degree(curve, 3);
    REQUIRE(leaves.size() == 3);
    REQUIRE(junctions.size() == 1);
    CHECK(curve.nodes.row(junctions[0]).norm() < 2.5 * 0.12 * scale);
    for (const Vec3& end : three_tube_ends()) {
        const Vec3 tip = scale * (end + 0.12 * end.normalized());
        double nearest = 1e300;
        for (const int leaf : leaves) nearest = std::min(nearest, (curve.nodes.row(leaf).transpose() - tip).norm());
        CHECK(nearest < 0.06 * scale);
    }
}

} // namespace

TEST_CASE("three tubes that meet: one junction, three leaves at their ends") {
    const Mesh mesh = three_tubes();
    const double scale = 1 / std::sqrt(surface_area(mesh));
    const Mesh unit = with_unit_area(mesh);
    const CurveSkeleton<double> curve = curve_of(unit);
    check_is_curve(curve, unit.vertices.rows());
    check_is_y(curve, scale);
}

TEST_CASE("the curve of three tubes runs along their axes") {
    const Mesh mesh = three_tubes();
    const double scale = 1 / std::sqrt(surface_area(mesh));
    const Mesh unit = with_unit_area(mesh);
    const CurveSkeleton<double> curve = curve_of(unit);
    for (Eigen::Index k = 0; k < curve.nodes.rows(); ++k) {
        const Vec3 p = curve.nodes.row(k).transpose() / scale;
        double from_axis = 1e300;
        for (const Vec3& end : three_tube_ends())
            from_axis = std::min(from_axis, segment_distance(p, Vec3::Zero(), 1.12 * end));
        INFO("node at " << p.transpose());
        CHECK(from_axis < 0.5 * 0.12);
    }
}

TEST_CASE("the curve of three tubes is a Y however they lie") {
    const Mesh mesh = three_tubes();
    const double scale = 1 / std::sqrt(surface_area(mesh));
    for (unsigned seed = 1; seed <= 3; ++seed) {
        INFO("rotation " << seed);
        const Motion motion{random_rotation(seed), 1, Vec3::Zero()};
        const Mesh unit = with_unit_area(moved(mesh, motion));
        CurveSkeleton<double> curve = curve_of(unit);
        curve.nodes = (curve.nodes * motion.rotation).eval();
        check_is_y(curve, scale);
    }
}

TEST_CASE("a capsule has a curve without junctions from pole to pole") {
    const Mesh unit = with_unit_area(capsule(0.2, 4));
    const CurveSkeleton<double> curve = curve_of(unit);
    check_is_curve(curve, unit.vertices.rows());
    CHECK(nodes_of_degree(curve, 1).size() == 2);
    CHECK(nodes_of_degree(curve, 2).size() + 2 == static_cast<std::size_t>(curve.nodes.rows()));
    const double pole_to_pole = unit.vertices.col(2).maxCoeff() - unit.vertices.col(2).minCoeff();
    CHECK(curve_diameter(curve_graph(curve)) == Approx(pole_to_pole).epsilon(0.05));
}

TEST_CASE("a torus has a curve with one cycle") {
    const Mesh unit = with_unit_area(torus(1, 0.25));
    const CurveSkeleton<double> curve = curve_of(unit);
    check_is_curve(curve, unit.vertices.rows());
    CHECK(pieces(curve) == 1);
    CHECK(cycles(curve) == 1);
}
