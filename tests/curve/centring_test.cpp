#include <skelgen/curve/contraction.hpp>
#include <skelgen/curve/impl/centring.hpp>
#include <skelgen/curve/surgery.hpp>

#include "catch.hpp"
#include "curve/proxy_mesh.hpp"
#include "shapes.hpp"

using namespace skelgen;
using namespace skelgen::curve;
using namespace skelgen::test;

TEMPLATE_TEST_CASE("nodes that have drifted off the axis come back to it", "", float, double) {
    const TriangleMesh<TestType> proxy = proxy_mesh(mesh_in<TestType>(capsule(0.2, 4)));
    Points<TestType> contracted = contract(proxy).vertices;
    contracted.col(0).array() += TestType(0.1); // half a radius off
    const CurveSkeleton<TestType> curve = connectivity_surgery(contracted, proxy.faces);
    const CurveSkeleton<TestType> centred = centre_nodes(curve, proxy, contracted);
    CHECK(centred.edges == curve.edges);
    CHECK(centred.regions == curve.regions);
    REQUIRE(centred.radii.size() == static_cast<std::size_t>(centred.nodes.rows()));
    int along_the_tube = 0;
    for (Eigen::Index k = 0; k < centred.nodes.rows(); ++k) {
        if (centred.nodes(k, 2) < 0.3 || centred.nodes(k, 2) > 3.7) continue;
        INFO("node at " << centred.nodes.row(k));
        CHECK(centred.nodes.row(k).template head<2>().norm() < 0.25 * 0.2);
        CHECK(centred.radii[static_cast<std::size_t>(k)] == Approx(0.2).epsilon(0.25));
        ++along_the_tube;
    }
    CHECK(along_the_tube >= 5);
}

TEST_CASE("the centred nodes of a torus lie on its circle, from which contraction has pulled them towards the hole") {
    const Mesh proxy = proxy_mesh(torus(1, 0.25));
    const Points<double> contracted = contract(proxy).vertices;
    const CurveSkeleton<double> curve = centre_nodes(connectivity_surgery(contracted, proxy.faces), proxy, contracted);
    for (Eigen::Index k = 0; k < curve.nodes.rows(); ++k) {
        INFO("node at " << curve.nodes.row(k));
        CHECK(curve.nodes.row(k).head<2>().norm() == Approx(1).margin(0.4 * 0.25));
        CHECK(curve.nodes(k, 2) == Approx(0).margin(0.2 * 0.25));
    }
}

TEST_CASE("a region whose boundary has no length, or that is empty, leaves its node finite") {
    Mesh mesh = cube();
    const Points<double> contracted = Points<double>::Zero(mesh.vertices.rows(), 3);
    mesh.vertices.row(1) = mesh.vertices.row(0);
    CurveSkeleton<double> curve;
    curve.nodes = Points<double>::Zero(3, 3);
    curve.edges = {{0, 1}, {1, 2}};
    curve.regions = {{0, 1}, {2, 3, 4, 5, 6, 7}, {}};
    const CurveSkeleton<double> centred = centre_nodes(curve, mesh, contracted);
    CHECK(centred.nodes.allFinite());
    CHECK(centred.nodes.row(2) == curve.nodes.row(2));
    CHECK(centred.radii[2] == 0);
}
