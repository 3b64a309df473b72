#include <algorithm>
#include <cmath>

#include <skelgen/curve/contraction.hpp>
#include <skelgen/curve/surgery.hpp>

#include "catch.hpp"
#include "curve/curve_expectations.hpp"
#include "curve/proxy_mesh.hpp"
#include "curve/throws.hpp"
#include "mesh_changes.hpp"
#include "shapes.hpp"

using namespace skelgen;
using namespace skelgen::core;
using namespace skelgen::curve;
using namespace skelgen::test;

namespace {

template <typename Scalar>
CurveSkeleton<Scalar> contracted_curve(const TriangleMesh<Scalar>& proxy) {
    return connectivity_surgery(contract(proxy).vertices, proxy.faces);
}

} // namespace

TEMPLATE_TEST_CASE("surgery leaves one connected graph, every vertex in the region of exactly one node", "[slow]",
                   float, double) {
    for (const Mesh& mesh : {sphere(1, 4), capsule(0.2, 4), torus(1, 0.25), three_tubes()}) {
        const TriangleMesh<TestType> proxy = proxy_mesh(mesh_in<TestType>(mesh), 1200);
        const CurveSkeleton<TestType> curve = contracted_curve(proxy);
        check_is_curve(curve, proxy.vertices.rows());
        CHECK(pieces(curve) == 1);
        CHECK(curve.nodes.rows() < proxy.vertices.rows() / 5);
    }
}

TEMPLATE_TEST_CASE("a torus leaves exactly one cycle, a sphere, a capsule and a Y none", "[slow]", float, double) {
    const auto cycles_of = [](const Mesh& mesh) {
        return cycles(contracted_curve(proxy_mesh(mesh_in<TestType>(mesh), 1200)));
    };
    CHECK(cycles_of(torus(1, 0.25)) == 1);
    CHECK(cycles_of(sphere(1, 4)) == 0);
    CHECK(cycles_of(capsule(0.2, 4)) == 0);
    CHECK(cycles_of(three_tubes()) == 0);
}

TEST_CASE("two tori joined by nothing leave two cycles in two pieces") {
    const Mesh ring = torus(1, 0.25, 48, 16);
    const Mesh mesh = side_by_side(ring, moved(ring, {random_rotation(1), 1, Vec3(5, 0, 0)}));
    const CurveSkeleton<double> curve = contracted_curve(mesh);
    CHECK(pieces(curve) == 2);
    CHECK(cycles(curve) == 2);
}

TEST_CASE("the cycle of a torus goes round its hole") {
    CurveSkeleton<double> curve = contracted_curve(proxy_mesh(torus(1, 0.25), 1200));
    double angle = 0; // sum over edges in the cycle's sense: walk along it
    const CurveGraph<double> graph = curve_graph(curve);
    std::vector<bool> cut(static_cast<std::size_t>(graph.size()), false);
    std::vector<int> degree;
    for (int v = 0; v < graph.size(); ++v) degree.push_back(graph.degree(v));
    for (bool changed = true; changed;) { // trees hang on the cycle: peel them off
        changed = false;
        for (int v = 0; v < graph.size(); ++v) {
            if (cut[static_cast<std::size_t>(v)] || degree[static_cast<std::size_t>(v)] != 1) continue;
            cut[static_cast<std::size_t>(v)] = changed = true;
            for (const auto& [w, length] : graph.neighbours[static_cast<std::size_t>(v)])
                --degree[static_cast<std::size_t>(w)];
        }
    }
    const int start = static_cast<int>(std::find(cut.begin(), cut.end(), false) - cut.begin());
    REQUIRE(start < graph.size());
    int previous = -1, here = start;
    do {
        int next = -1;
        for (const auto& [w, length] : graph.neighbours[static_cast<std::size_t>(here)])
            if (!cut[static_cast<std::size_t>(w)] && w != previous) next = w;
        REQUIRE(next >= 0);
        const Vec3 a = curve.nodes.row(here), b = curve.nodes.row(next);
        angle += std::atan2(a.cross(b).z(), a.dot(b));
        previous = here;
        here = next;
    } while (here != start);
    CHECK(std::abs(angle) == Approx(2 * pi));
}

TEST_CASE("a mesh without faces stays as it is") {
    const CurveSkeleton<double> curve = connectivity_surgery(sphere(1, 1).vertices, Triangles(0, 3));
    CHECK(curve.nodes.rows() == sphere(1, 1).vertices.rows());
    CHECK(curve.edges.empty());
}

TEST_CASE("surgery refuses weights that make no sense") {
    const Mesh mesh = sphere(1, 1);
    for (const SurgeryOptions& options : {SurgeryOptions{-1, 3}, SurgeryOptions{1, std::nan("")}})
        CHECK(throws(ErrorCode::usage,
                     [&] { static_cast<void>(connectivity_surgery(mesh.vertices, mesh.faces, options)); }));
}
