#include <algorithm>
#include <cmath>

#include <skelgen/core/curve_graph.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/curve/find_curve.hpp>
#include <skelgen/curve/impl/regions.hpp>

#include "catch.hpp"
#include "curve/curve_expectations.hpp"
#include "curve/proxy_mesh.hpp"
#include "curve/throws.hpp"
#include "curve/unit_body.hpp"
#include "mesh_changes.hpp"
#include "shapes.hpp"

using namespace skelgen;
using namespace skelgen::core;
using namespace skelgen::curve;
using namespace skelgen::test;

namespace {

/// From the Y's three ends down to its one junction.
template <typename Scalar>
void check_is_y(const CurveSkeleton<Scalar>& curve, double scale) {
    CHECK(pieces(curve) == 1);
    CHECK(cycles(curve) == 0);
    const std::vector<int> leaves = nodes_of_degree(curve, 1), junctions = nodes_of_degree(curve, 3);
    REQUIRE(leaves.size() == 3);
    REQUIRE(junctions.size() == 1);
    CHECK(curve.nodes.row(junctions[0]).norm() < 2.5 * 0.12 * scale);
    for (const Vec3& end : three_tube_ends()) {
        const Vec3 tip = scale * (end + 0.12 * end.normalized());
        double nearest = 1e300;
        for (const int leaf : leaves)
            nearest = std::min(nearest, (curve.nodes.row(leaf).transpose().template cast<double>() - tip).norm());
        CHECK(nearest < 0.06 * scale);
    }
}

} // namespace

TEMPLATE_TEST_CASE("three tubes that meet: one junction, three leaves at their ends", "[slow]", float, double) {
    const Mesh mesh = three_tubes();
    const CurveResult<TestType> found = find_curve(unit_body<TestType>(mesh));
    check_is_curve(found.curve, mesh.vertices.rows());
    check_is_y(found.curve, 1 / std::sqrt(surface_area(mesh)));
    CHECK(found.converged);
    CHECK(found.iterations > 1);
    CHECK(found.volume_ratio < 0.1);
}

TEST_CASE("the curve of three tubes runs along their axes", "[slow]") {
    const Mesh mesh = three_tubes();
    const double scale = 1 / std::sqrt(surface_area(mesh));
    const CurveSkeleton<double> curve = find_curve(unit_body(mesh)).curve;
    for (Eigen::Index k = 0; k < curve.nodes.rows(); ++k) {
        const Vec3 p = curve.nodes.row(k).transpose() / scale;
        double from_axis = 1e300;
        for (const Vec3& end : three_tube_ends())
            from_axis = std::min(from_axis, segment_distance(p, Vec3::Zero(), 1.12 * end));
        INFO("node at " << p.transpose());
        CHECK(from_axis < 0.5 * 0.12);
    }
}

TEST_CASE("the curve of three tubes is a Y however they lie", "[slow]") {
    const Mesh mesh = three_tubes();
    const double scale = 1 / std::sqrt(surface_area(mesh));
    for (unsigned seed = 1; seed <= 3; ++seed) {
        INFO("rotation " << seed);
        const Motion motion{random_rotation(seed), 1, Vec3::Zero()};
        CurveSkeleton<double> curve = find_curve(unit_body(moved(mesh, motion))).curve;
        curve.nodes = (curve.nodes * motion.rotation).eval();
        check_is_y(curve, scale);
    }
}

TEST_CASE("a capsule has a curve without junctions from pole to pole", "[slow]") {
    const Body<double> body = unit_body(capsule(0.2, 4));
    const CurveSkeleton<double> curve = find_curve(body).curve;
    check_is_curve(curve, body.mesh.vertices.rows());
    CHECK(nodes_of_degree(curve, 1).size() == 2);
    CHECK(nodes_of_degree(curve, 2).size() + 2 == static_cast<std::size_t>(curve.nodes.rows()));
    const double pole_to_pole = body.mesh.vertices.col(2).maxCoeff() - body.mesh.vertices.col(2).minCoeff();
    CHECK(curve_diameter(curve_graph(curve)) == Approx(pole_to_pole).epsilon(0.05));
}

TEMPLATE_TEST_CASE("a torus has a curve with one cycle", "", float, double) {
    const Mesh mesh = torus(1, 0.25);
    const CurveSkeleton<TestType> curve = find_curve(unit_body<TestType>(mesh)).curve;
    check_is_curve(curve, mesh.vertices.rows());
    CHECK(pieces(curve) == 1);
    CHECK(cycles(curve) == 1);
}

TEST_CASE("beside the ends of its limbs a curve lies inside, and its nodes have radii", "[slow]") {
    const Body<double> body = unit_body(three_tubes());
    const CurveSkeleton<double> curve = find_curve(body).curve;
    const CurveGraph<double> graph = curve_graph(curve);
    REQUIRE(curve.radii.size() == curve.regions.size());
    CHECK(*std::min_element(curve.radii.begin(), curve.radii.end()) > 0);
    for (const int leaf : nodes_of_degree(curve, 1)) {
        const int beside = graph.neighbours[static_cast<std::size_t>(leaf)][0].first;
        CHECK(winding_number(body.mesh, Vec3(curve.nodes.row(beside))) > 0.5);
    }
}

TEST_CASE("a curve says when its contraction has not come to its end", "[slow]") {
    CurveOptions options;
    options.contraction.iterations = 1;
    const CurveResult<double> found = find_curve(unit_body(three_tubes()), options);
    CHECK_FALSE(found.converged);
    CHECK(found.iterations == 1);
}

TEST_CASE("a draft has the ends, junctions and loops of the curve, near their places, and made whole is that curve") {
    CurveOptions roughly;
    roughly.is_draft = true;
    const Mesh mesh = three_tubes();
    for (const Body<double>& body : {unit_body(mesh), unit_body(torus(1, 0.25))}) {
        const CurveResult<double> draft = find_curve(body, roughly), whole = find_curve(body);
        CHECK(draft.is_draft);
        CHECK_FALSE(whole.is_draft);
        CHECK(2 * draft.curve.nodes.rows() < whole.curve.nodes.rows() + 10);
        CHECK(cycles(draft.curve) == cycles(whole.curve));
        for (Eigen::Index k = 0; k < draft.curve.nodes.rows(); ++k) {
            const Vec3 node = point(draft.curve.nodes, k);
            CHECK(draft.curve.radii[static_cast<std::size_t>(k)] == body.tree.distance(body.mesh, node));
            CHECK(std::sqrt((whole.curve.nodes.rowwise() - node.transpose()).rowwise().squaredNorm().minCoeff()) <
                  0.05 * bounding_diagonal(body.mesh.vertices));
        }
        for (const CurveResult<double>& finished_curve : {finished(draft, body), finished(whole, body)}) {
            CHECK_FALSE(finished_curve.is_draft);
            CHECK(finished_curve.curve.nodes == whole.curve.nodes);
            CHECK(finished_curve.curve.edges == whole.curve.edges);
            CHECK(finished_curve.curve.radii == whole.curve.radii);
            CHECK(finished_curve.curve.regions == whole.curve.regions);
        }
    }
    check_is_y(find_curve(unit_body(mesh), roughly).curve, 1 / std::sqrt(surface_area(mesh)));
}

TEST_CASE("the curve stage refuses options of any of its steps that make no sense") {
    const Body<double> body = unit_body(capsule(0.2, 4));
    CurveOptions proxy, contraction, surgery, leaves, pruning;
    proxy.proxy.vertices = 0;
    contraction.contraction.iterations = 0;
    surgery.surgery.shape_weight = -1;
    leaves.leaves.anchor = 2;
    pruning.pruning.branch = -1;
    for (const CurveOptions& options : {proxy, contraction, surgery, leaves, pruning})
        CHECK(throws(ErrorCode::usage, [&] { static_cast<void>(find_curve(body, options)); }));
    CHECK_NOTHROW(validate(CurveOptions{}));
}

TEST_CASE("regions spread along the surface: what is near in space alone does not take them") {
    const Body<double> plate = body_of(box({1, 1, 0.02}, 4)); // two sheets nearer to each other than vertices are
    const Proxy<double> proxy = build_proxy(plate.mesh);
    CurveSkeleton<double> sheets;
    sheets.nodes = Points<double>::Zero(2, 3);
    sheets.regions.resize(2);
    for (int v = 0; v < proxy.mesh.vertices.rows(); ++v) sheets.regions[proxy.mesh.vertices(v, 2) > 0.01].push_back(v);
    const CurveSkeleton<double> spread = spread_regions(sheets, nearest_of_proxy(proxy, plate), proxy);
    check_is_curve(spread, plate.mesh.vertices.rows());
    const std::vector<int> node = node_of_vertex(spread, plate.mesh.vertices.rows());
    for (Eigen::Index v = 0; v < plate.mesh.vertices.rows(); ++v) {
        const auto from_edge = plate.mesh.vertices.row(v).head<2>();
        if (from_edge.minCoeff() < 0.1 || from_edge.maxCoeff() > 0.9) continue;
        CHECK(node[static_cast<std::size_t>(v)] == (plate.mesh.vertices(v, 2) > 0.01 ? 1 : 0));
    }
}
