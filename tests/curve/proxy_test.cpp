#include <algorithm>
#include <cmath>

#include <skelgen/core/geometry.hpp>
#include <skelgen/curve/proxy.hpp>
#include <skelgen/surface/manifold_parts.hpp>

#include "catch.hpp"
#include "curve/proxy_mesh.hpp"
#include "curve/throws.hpp"
#include "mesh_changes.hpp"
#include "shapes.hpp"

using namespace skelgen;
using namespace skelgen::core;
using namespace skelgen::curve;
using namespace skelgen::test;

namespace {

struct Case {
    const char* name;
    Mesh mesh;
    int euler;
    double shape = 0.04; ///< how much area and volume may change, relative
};

std::vector<Case> cases() {
    return {{"sphere, coarse", sphere(1, 2), 2},
            {"sphere, fine", sphere(1, 6), 2},
            {"torus", torus(1, 0.3), 0},
            {"three tubes with slivers", three_tubes(), 2},
            {"capsule of needles along its axis", capsule(0.2, 4, 64, 4), 2, 0.08},
            {"torus of needles across its tube", torus(1, 0.3, 400, 8), 0},
            {"cube of twelve faces", cube(), 2}};
}

/// Part of the edges between `low` and `high` times the edge of equilateral triangles.
double part_of_edges_between(const Mesh& mesh, double low, double high, int vertices) {
    const double edge = std::sqrt(2 * surface_area(mesh) / (std::sqrt(3.0) * vertices));
    double good = 0;
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            const double length =
                (mesh.vertices.row(mesh.faces(f, k)) - mesh.vertices.row(mesh.faces(f, (k + 1) % 3))).norm();
            good += length >= low * edge && length <= high * edge;
        }
    return good / (3.0 * static_cast<double>(mesh.faces.rows()));
}

} // namespace

TEMPLATE_TEST_CASE("a proxy has the size asked for, whatever the input's, and its topology", "[slow]", float, double) {
    constexpr int vertices = 1500;
    for (const Case& c : cases()) {
        INFO(c.name);
        const TriangleMesh<TestType> proxy = proxy_mesh(mesh_in<TestType>(c.mesh), vertices);
        CHECK(proxy.vertices.rows() > vertices * 7 / 10);
        CHECK(proxy.vertices.rows() < vertices * 14 / 10);
        CHECK(is_closed(proxy.faces));
        CHECK(euler_characteristic(proxy.faces) == c.euler);
    }
}

TEST_CASE("a proxy's edges are about as long as equilateral triangles of its size have them", "[slow]") {
    for (const Case& c : cases()) {
        INFO(c.name);
        CHECK(part_of_edges_between(proxy_mesh(c.mesh), 0.6, 1.5, 1500) > 0.97);
    }
}

TEMPLATE_TEST_CASE("a proxy keeps the shape", "[slow]", float, double) {
    for (const Case& c : cases()) {
        INFO(c.name);
        const TriangleMesh<TestType> proxy = proxy_mesh(mesh_in<TestType>(c.mesh));
        CHECK(enclosed_volume(proxy) == Approx(enclosed_volume(c.mesh)).epsilon(c.shape));
        CHECK(surface_area(proxy) == Approx(surface_area(c.mesh)).epsilon(c.shape));
    }
}

TEST_CASE("a hole stays a hole") {
    const Mesh whole = sphere(1, 4);
    Mesh open = whole; // without its north cap
    Eigen::Index kept = 0;
    for (Eigen::Index f = 0; f < whole.faces.rows(); ++f) {
        const double lowest = std::min({whole.vertices(whole.faces(f, 0), 2), whole.vertices(whole.faces(f, 1), 2),
                                        whole.vertices(whole.faces(f, 2), 2)});
        if (lowest < 0.8) open.faces.row(kept++) = whole.faces.row(f);
    }
    open.faces.conservativeResize(kept, 3);
    open = surface::largest_manifold_part(open).mesh;
    REQUIRE(euler_characteristic(open.faces) == 1);
    const Mesh proxy = proxy_mesh(open);
    CHECK(euler_characteristic(proxy.faces) == 1);
    CHECK(surface_area(proxy) == Approx(surface_area(open)).epsilon(0.05));
}

TEST_CASE("neither a fan of needles nor a finely divided rim makes a proxy large", "[slow]") {
    constexpr int vertices = 1500;
    const Mesh lids = cylinder(0.3, 4, 500, 2);
    Mesh disc; // one vertex in the middle of 1000 on the rim
    disc.vertices = Points<double>::Zero(1001, 3);
    disc.faces.resize(1000, 3);
    for (int k = 0; k < 1000; ++k) {
        disc.vertices.row(k) << std::cos(2 * pi * k / 1000), std::sin(2 * pi * k / 1000), 0;
        disc.faces.row(k) << k, (k + 1) % 1000, 1000;
    }
    for (const Mesh& mesh : {lids, disc}) {
        const Mesh proxy = proxy_mesh(mesh, vertices);
        CHECK(proxy.vertices.rows() > vertices * 7 / 10);
        CHECK(proxy.vertices.rows() < vertices * 14 / 10);
        CHECK(euler_characteristic(proxy.faces) == euler_characteristic(mesh.faces));
    }
}

TEMPLATE_TEST_CASE("an edge without length costs a proxy nothing", "", float, double) {
    Mesh mesh = cube();
    mesh.vertices.row(1) = mesh.vertices.row(0);
    const TriangleMesh<TestType> proxy = proxy_mesh(mesh_in<TestType>(mesh), 1500);
    CHECK(proxy.vertices.allFinite());
    CHECK(proxy.vertices.rows() > 1050);
    CHECK(proxy.vertices.rows() < 2100);
}

TEST_CASE("the same mesh has the same proxy", "[slow]") {
    const Mesh a = proxy_mesh(three_tubes()), b = proxy_mesh(three_tubes());
    const bool same_vertices = a.vertices == b.vertices, same_faces = a.faces == b.faces;
    CHECK(same_vertices);
    CHECK(same_faces);
}

TEST_CASE("a proxy's vertices come from vertices nearby on the same sheet of surface") {
    const Mesh plate = box({1, 1, 0.02}, 5); // two sheets much nearer to each other than vertices are
    const Proxy<double> proxy = build_proxy(plate);
    const Points<double> normals = vertex_normals(plate), proxy_normals = vertex_normals(proxy.mesh);
    REQUIRE(proxy.source.size() == static_cast<std::size_t>(proxy.mesh.vertices.rows()));
    int known = 0;
    for (Eigen::Index v = 0; v < proxy.mesh.vertices.rows(); ++v) {
        const int source = proxy.source[static_cast<std::size_t>(v)];
        if (source < 0) continue;
        REQUIRE(source < plate.vertices.rows());
        ++known;
        CHECK((proxy.mesh.vertices.row(v) - plate.vertices.row(source)).norm() < 0.15);
        if (std::abs(proxy_normals(v, 2)) > 0.9 && std::abs(normals(source, 2)) > 0.9)
            CHECK(proxy_normals(v, 2) * normals(source, 2) > 0);
    }
    CHECK(known > proxy.mesh.vertices.rows() / 4);
}

TEST_CASE("a surface that is not manifold is bad input") {
    Mesh fin = sphere(1, 2);
    fin.faces.conservativeResize(fin.faces.rows() + 1, 3);
    fin.faces.bottomRows<1>() << fin.faces(0, 0), fin.faces(0, 1), fin.faces(100, 2);
    CHECK(throws(ErrorCode::bad_input, [&] { static_cast<void>(proxy_mesh(fin)); }));
}

TEST_CASE("a vertex far off the rest of the surface is refused before it is split to") {
    Mesh stray = sphere(1, 4);
    stray.vertices.row(0) *= 1000;
    CHECK(throws(ErrorCode::bad_input, [&] { static_cast<void>(proxy_mesh(stray)); }));
}

TEST_CASE("a surface without area is bad input") {
    Mesh point = sphere(1, 2);
    point.vertices.setConstant(0.25);
    CHECK(throws(ErrorCode::bad_input, [&] { static_cast<void>(proxy_mesh(point)); }));
}

TEMPLATE_TEST_CASE("vertices that lie upon each other around a place do not outlast the collapses there", "", float,
                   double) {
    Mesh mesh = sphere(1, 5);
    for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) // some two hundred of them, as rounding makes them
        if (mesh.vertices(v, 2) > 0.95) mesh.vertices.row(v) << 0, 0, 1;
    const TriangleMesh<TestType> proxy = proxy_mesh(mesh_in<TestType>(mesh), 500);
    CHECK(proxy.vertices.allFinite());
    CHECK(is_closed(proxy.faces));
    int upon_each_other = 0;
    for (Eigen::Index v = 0; v < proxy.vertices.rows(); ++v)
        upon_each_other += (proxy.vertices.row(v) - Vector3<TestType>::UnitZ().transpose()).norm() < TestType(1e-3);
    CHECK(upon_each_other <= 1);
}

TEST_CASE("a proxy refuses numbers of vertices and rounds that make no sense") {
    const Mesh mesh = sphere(1, 2);
    for (const ProxyOptions& options : {ProxyOptions{0, 4}, ProxyOptions{-3000, 4}, ProxyOptions{2000000000, 4},
                                        ProxyOptions{3000, -1}, ProxyOptions{3000, 1000000}})
        CHECK(throws(ErrorCode::usage, [&] { static_cast<void>(build_proxy(mesh, options)); }));
}
