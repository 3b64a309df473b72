#include <algorithm>

#include <skelgen/curve/contraction.hpp>
#include <skelgen/curve/surgery.hpp>

#include "catch.hpp"
#include "curve/curve_expectations.hpp"
#include "curve/proxy_mesh.hpp"
#include "mesh_changes.hpp"
#include "shapes.hpp"

using namespace skelgen;
using namespace skelgen::test;

namespace {

CurveSkeleton<double> contracted_curve(const Mesh& proxy) {
    return connectivity_surgery(contract(proxy).vertices, proxy.faces);
}

} // namespace

TEST_CASE("surgery leaves one connected graph, every vertex in the region of exactly one node") {
    for (const Mesh& mesh : {sphere(1, 4), capsule(0.2, 4), torus(1, 0.25), three_tubes()}) {
        const Mesh proxy = proxy_mesh(mesh, 1200);
        const CurveSkeleton<double> curve = contracted_curve(proxy);
        check_is_curve(curve, proxy.vertices.rows());
        CHECK(pieces(curve) == 1);
        CHECK(curve.nodes.rows() < proxy.vertices.rows() / 5);
    }
}

TEST_CASE("a torus leaves exactly one cycle, a sphere, a capsule and a Y none") {
    CHECK(cycles(contracted_curve(proxy_mesh(torus(1, 0.25), 1200))) == 1);
    CHECK(cycles(contracted_curve(proxy_mesh(sphere(1, 4), 1200))) == 0);
    CHECK(cycles(contracted_curve(proxy_mesh(capsule(0.2, 4), 1200))) == 0);
    CHECK(cycles(contracted_curve(proxy_mesh(three_tubes(), 1200))) == 0);
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
