#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <skelgen/core/adjacency.hpp>
#include <skelgen/core/geodesics.hpp>

#include "catch.hpp"
#include "mesh_changes.hpp"
#include "shapes.hpp"

using namespace skelgen;
using namespace skelgen::core;
using namespace skelgen::test;

namespace {

SurfaceGraph<double> graph_of(const Mesh& mesh) { return surface_graph(mesh, face_adjacency(mesh.faces)); }

double diameter(const Mesh& mesh) { return geodesic_diameter(graph_of(mesh)); }

} // namespace

TEST_CASE("the antipodes of a sphere are half a great circle apart") {
    for (const int times : {3, 4, 5}) {
        INFO("subdivided " << times << " times");
        CHECK(diameter(sphere(1.5, times)) == Approx(1.5 * pi).epsilon(0.03));
    }
}

TEST_CASE("from pole to pole of a capsule: its length and half its circumference") {
    CHECK(diameter(capsule(0.2, 4)) == Approx(4 + 0.2 * pi).epsilon(0.03));
    CHECK(diameter(capsule(0.5, 1)) == Approx(1 + 0.5 * pi).epsilon(0.03));
}

TEST_CASE("from lid to lid of a cylinder: its length and both radii") {
    CHECK(diameter(cylinder(0.2, 5)) == Approx(5.4).epsilon(0.03));
}

TEST_CASE("from corner to opposite corner of a cube, unfolded") {
    const double exact = std::hypot(2, 1),
                 along_a_square_grid = 1 + std::sqrt(2); // its steps go straight and diagonally
    CHECK(diameter(cube(4)) >= exact - 1e-12);
    CHECK(diameter(cube(4)) <= along_a_square_grid + 1e-12);
}

TEST_CASE("the geodesic diameter grows with the mesh and does not turn with it") {
    const Mesh mesh = three_tubes();
    const double before = diameter(mesh);
    CHECK(diameter(moved(mesh, {random_rotation(1), 1000, Vec3(1, 2, 3)})) == Approx(1000 * before).epsilon(1e-9));
    CHECK(diameter(shuffled(mesh, 1)) == Approx(before).epsilon(0.01));
}

TEST_CASE("no path is shorter than the straight line", "[slow]") {
    const Mesh mesh = three_tubes();
    double farthest = 0;
    for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v)
        farthest = std::max(farthest, (mesh.vertices.rowwise() - mesh.vertices.row(v)).rowwise().norm().maxCoeff());
    CHECK(diameter(mesh) >= farthest);
}

TEST_CASE("distances by slots are those of the shortest paths, to the last bit") {
    for (const Mesh& mesh : {three_tubes(), torus(1, 0.3, 400, 8), shuffled(capsule(0.2, 4), 2)}) {
        const SurfaceGraph<double> graph = graph_of(mesh);
        const int other = graph.size() / 2;
        const std::vector<double> one = shortest_paths(graph, 0).distance, two = shortest_paths(graph, other).distance;
        CHECK(distances_from(graph, {0}) == one);
        const std::vector<double> nearest = distances_from(graph, {0, other});
        for (std::size_t v = 0; v < nearest.size(); ++v) CHECK(nearest[v] == std::min(one[v], two[v]));
    }
}

TEST_CASE(
    "the nearest source on a surface: its own distance counts, of equals the lowest label, none where none leads") {
    const Mesh mesh =
        side_by_side(capsule(0.2, 4), moved(sphere(0.3, 2), {Eigen::Matrix3d::Identity(), 1, Vec3(3, 0, 0)}));
    const SurfaceGraph<double> graph = graph_of(mesh);
    const int last = static_cast<int>(capsule(0.2, 4).vertices.rows()) - 1;
    const std::vector<double> one = shortest_paths(graph, 0).distance, two = shortest_paths(graph, last).distance;
    const std::vector<int> found = nearest_source<double>(graph, {{-0.5, 7, 0}, {1.5, 2, last}, {1.5, 4, last}});
    for (std::size_t v = 0; v < found.size(); ++v)
        CHECK(found[v] == (std::isinf(one[v]) ? -1 : 1.5 + two[v] <= one[v] - 0.5 ? 2 : 7));
    CHECK(distances_from(graph, {}) == std::vector<double>(found.size(), std::numeric_limits<double>::infinity()));
}

TEST_CASE("on a square grid the surface's graph leads along eight directions: at worst 8 % too far") {
    const Mesh mesh = box({1, 1, 0.1}, 4);
    const SurfaceGraph<double> graph = graph_of(mesh);
    REQUIRE(graph.size() == mesh.vertices.rows());
    int corner = 0;
    while (mesh.vertices.row(corner).norm() > 0) ++corner;
    const std::vector<double> distance = shortest_paths(graph, corner).distance;
    for (int v = 0; v < graph.size(); ++v) {
        if (mesh.vertices(v, 2) > 0) continue;
        const double straight = mesh.vertices.row(v).norm();
        INFO("to " << mesh.vertices.row(v));
        CHECK(distance[static_cast<std::size_t>(v)] >= straight - 1e-12);
        CHECK(distance[static_cast<std::size_t>(v)] <= 1.083 * straight + 1e-12);
    }
}

TEST_CASE("a sphere's graph measures great circles within a few per cent") {
    const Mesh mesh = sphere(1, 4);
    const std::vector<double> distance = shortest_paths(graph_of(mesh), 0).distance;
    for (Eigen::Index v = 1; v < mesh.vertices.rows(); ++v) {
        const double arc = std::atan2(mesh.vertices.row(0).transpose().cross(mesh.vertices.row(v).transpose()).norm(),
                                      mesh.vertices.row(0).dot(mesh.vertices.row(v)));
        REQUIRE(distance[static_cast<std::size_t>(v)] == Approx(arc).epsilon(0.08));
    }
}

TEST_CASE("single precision measures as double precision does") {
    const Mesh mesh = three_tubes();
    const TriangleMesh<float> rounded{mesh.vertices.cast<float>(), mesh.faces};
    CHECK(geodesic_diameter(surface_graph(rounded, face_adjacency(rounded.faces))) ==
          Approx(diameter(mesh)).epsilon(1e-5));
}
