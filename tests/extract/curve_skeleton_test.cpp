#include <algorithm>
#include <limits>
#include <numeric>
#include <set>
#include <vector>

#include <skelgen/core/curve_graph.hpp>
#include <skelgen/core/error.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/extract.hpp>

#include "catch.hpp"
#include "mesh_changes.hpp"
#include "shapes.hpp"

using namespace skelgen;
using namespace skelgen::core;
using namespace skelgen::test;

namespace {

std::vector<int> vertices_in_regions(const CurveSkeleton<double>& curve) {
    std::vector<int> vertices;
    for (const auto& region : curve.regions) vertices.insert(vertices.end(), region.begin(), region.end());
    std::sort(vertices.begin(), vertices.end());
    return vertices;
}

std::vector<int> first_numbers(Eigen::Index count) {
    std::vector<int> numbers(static_cast<std::size_t>(count));
    std::iota(numbers.begin(), numbers.end(), 0);
    return numbers;
}

std::set<int> one_ring(const Triangles& faces, int vertex) {
    std::set<int> ring;
    for (Eigen::Index f = 0; f < faces.rows(); ++f)
        if ((faces.row(f).array() == vertex).any()) ring.insert({faces(f, 0), faces(f, 1), faces(f, 2)});
    return ring;
}

/// A vertex near `vertex` that shares no neighbour with it.
int nearest_apart(const Mesh& mesh, int vertex) {
    const std::set<int> ring = one_ring(mesh.faces, vertex);
    int nearest = -1;
    double distance = std::numeric_limits<double>::infinity();
    for (int v = 0; v < static_cast<int>(mesh.vertices.rows()); ++v) {
        const double d = (mesh.vertices.row(v) - mesh.vertices.row(vertex)).norm();
        if (d >= distance) continue;
        const std::set<int> other = one_ring(mesh.faces, v);
        if (std::none_of(other.begin(), other.end(), [&](int w) { return ring.count(w) > 0; })) {
            nearest = v;
            distance = d;
        }
    }
    return nearest;
}

} // namespace

TEST_CASE("the curve alone is found in the caller's coordinates, and ends where the limbs do") {
    const Motion motion{random_rotation(3), 40, {100, -200, 300}};
    const Mesh mesh = moved(three_tubes(), motion);
    const CurveSkeleton<double> curve = find_curve_skeleton(mesh);
    for (const Vec3& end : three_tube_ends()) {
        const Vec3 expected = motion.apply(end);
        const double nearest = (curve.nodes.rowwise() - expected.transpose()).rowwise().norm().minCoeff();
        CHECK(nearest < 0.2 * motion.scale);
    }
}

TEST_CASE("every node of the curve has a radius, and its inner nodes lie inside") {
    const Mesh mesh = three_tubes();
    const CurveSkeleton<double> curve = find_curve_skeleton(mesh);
    const CurveGraph<double> graph = curve_graph(curve);
    for (int node = 0; node < graph.size(); ++node) {
        CHECK(curve.radii[static_cast<std::size_t>(node)] > 0);
        if (graph.degree(node) > 1) CHECK(winding_number(mesh, Vec3(curve.nodes.row(node).transpose())) > 0.5);
    }
}

TEST_CASE("the regions of the curve hold every vertex of the largest piece exactly once") {
    const Mesh body = three_tubes();
    SECTION("one piece") {
        CHECK(vertices_in_regions(find_curve_skeleton(body)) == first_numbers(body.vertices.rows()));
    }
    SECTION("a smaller piece beside it") {
        const Mesh both = side_by_side(body, moved(sphere(0.05, 2), {Eigen::Matrix3d::Identity(), 1, {3, 3, 3}}));
        CHECK(vertices_in_regions(find_curve_skeleton(both)) == first_numbers(body.vertices.rows()));
    }
    SECTION("two fans of faces touch in one vertex") {
        Mesh touching = body;
        const int kept = 0, fused = nearest_apart(body, kept);
        REQUIRE(fused > 0);
        touching.faces = touching.faces.unaryExpr([&](int v) { return v == fused ? kept : v; }).eval();
        std::vector<int> expected = first_numbers(body.vertices.rows());
        std::erase(expected, fused); // no face uses it any more
        CHECK(vertices_in_regions(find_curve_skeleton(touching)) == expected);
    }
}

TEST_CASE("one component's curve is that of the largest piece; something small far away makes the spacing wider") {
    const Mesh body = three_tubes();
    const auto alone = find_curves(body);
    REQUIRE(alone.size() == 1);
    const CurveSkeleton<double> expected = find_curve_skeleton(body);
    REQUIRE(alone.front().curve.edges == expected.edges);
    CHECK((alone.front().curve.nodes - expected.nodes).cwiseAbs().maxCoeff() < 1e-9);

    const Mesh speck = moved(sphere(0.005, 2), {Eigen::Matrix3d::Identity(), 1, {0, 0, 5}});
    const auto beside = find_curves(side_by_side(body, speck));
    REQUIRE(beside.size() == 1);
    CHECK(beside.front().curve.nodes.rows() < expected.nodes.rows() / 2);
}

TEST_CASE("where no piece encloses anything there is no curve to be found") {
    Mesh soup{Points<double>(12, 3), Triangles(4, 3)}; // four triangles apart
    for (int f = 0; f < 4; ++f) {
        soup.vertices.middleRows(3 * f, 3) << f, 0, 0, f, 1, 0, f, 0, 1;
        soup.faces.row(f) << 3 * f, 3 * f + 1, 3 * f + 2;
    }
    try {
        static_cast<void>(find_curves(soup));
        FAIL("a curve was found");
    } catch (const Error& error) {
        CHECK(error.code() == ErrorCode::bad_input);
        CHECK_THAT(error.what(), Catch::Matchers::Contains("encloses anything"));
    }
}
