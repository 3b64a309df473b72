#include <skelgen/surface/vertex_clusters.hpp>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include <skelgen/core/geometry.hpp>
#include <skelgen/core/parallel.hpp>
#include <skelgen/extract.hpp>
#include <skelgen/surface/denoise.hpp>
#include <skelgen/surface/impl/sound_faces.hpp>
#include <skelgen/surface/prepare.hpp>

#include "catch.hpp"
#include "mesh_changes.hpp"
#include "shapes.hpp"

using namespace skelgen;
using namespace skelgen::surface;
using namespace skelgen::test;

namespace {

/// The places of a mesh's vertices, in no order.
std::set<std::array<double, 3>> places_of(const Points<double>& vertices) {
    std::set<std::array<double, 3>> out;
    for (Eigen::Index v = 0; v < vertices.rows(); ++v) out.insert({vertices(v, 0), vertices(v, 1), vertices(v, 2)});
    return out;
}

/// Without the faces that begin in a ball.
Mesh without_ball(const Mesh& mesh, const Vec3& middle, double radius) {
    Mesh out{mesh.vertices, Triangles(mesh.faces.rows(), 3)};
    Eigen::Index kept = 0;
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f)
        if ((core::point(mesh.vertices, mesh.faces(f, 0)) - middle).norm() > radius)
            out.faces.row(kept++) = mesh.faces.row(f);
    out.faces.conservativeResize(kept, 3);
    return out;
}

void check_way_back(const ClusteredMesh<double>& coarse, const Mesh& fine) {
    REQUIRE(coarse.cluster.size() == static_cast<std::size_t>(fine.vertices.rows()));
    REQUIRE(coarse.source.size() == static_cast<std::size_t>(coarse.mesh.vertices.rows()));
    for (std::size_t c = 0; c < coarse.source.size(); ++c) {
        const int source = coarse.source[c];
        CHECK(coarse.mesh.vertices.row(static_cast<Eigen::Index>(c)) == fine.vertices.row(source));
        CHECK(coarse.cluster[static_cast<std::size_t>(source)] == static_cast<int>(c));
    }
}

} // namespace

TEMPLATE_TEST_CASE("a fine surface becomes a coarse one of the same shape and kind", "[surface]", float, double) {
    const Mesh ball = sphere(2, 6);
    const TriangleMesh<TestType> fine{ball.vertices.cast<TestType>(), ball.faces};
    const auto coarse = cluster_vertices(fine, 8000);
    CHECK(static_cast<double>(coarse.mesh.faces.rows()) == Approx(8000).epsilon(0.1));
    CHECK(is_sound(coarse.mesh));
    CHECK(euler_characteristic(coarse.mesh.faces) == 2);
    CHECK(core::enclosed_volume(coarse.mesh) == Approx(core::enclosed_volume(fine)).epsilon(0.003));
    CHECK(core::surface_area(coarse.mesh) == Approx(core::surface_area(fine)).epsilon(0.01));
}

TEST_CASE("each vertex of the fine surface is stood for by one near it", "[surface]") {
    const Mesh fine = torus(2, 0.7, 400, 150);
    const auto coarse = cluster_vertices(fine, 6000);
    check_way_back(coarse, fine);
    CHECK(euler_characteristic(coarse.mesh.faces) == 0);
    const double area = core::surface_area(fine), cell = std::sqrt(1.26 * area / 3000);
    for (std::size_t v = 0; v < coarse.cluster.size(); ++v) {
        const Vec3 place = core::point(fine.vertices, static_cast<Eigen::Index>(v));
        CHECK((place - core::point(coarse.mesh.vertices, coarse.cluster[v])).norm() < 2 * cell);
    }
}

TEST_CASE("what is thinner than a cell is not pinched off", "[surface]") {
    const Mesh thin = torus(1, 0.02, 1500, 20); // cells as wide as the tube
    const auto ring = cluster_vertices(thin, 500);
    CHECK(is_sound(ring.mesh));
    CHECK(euler_characteristic(ring.mesh.faces) == 0);
    const Mesh finger = capsule(0.05, 10, 24, 900);
    const auto coarse = cluster_vertices(finger, 900);
    CHECK(is_sound(coarse.mesh));
    CHECK(euler_characteristic(coarse.mesh.faces) == 2);
    check_way_back(coarse, finger);
}

TEST_CASE("a boundary stays as it is", "[surface]") {
    const Mesh whole = sphere(1, 6);
    const Mesh open = without_faces(whole, 100, 1);
    const auto coarse = cluster_vertices(open, 8000);
    REQUIRE(coarse.mesh.faces.rows() < 10000);
    CHECK(euler_characteristic(coarse.mesh.faces) == 1);
    const auto kept = places_of(coarse.mesh.vertices);
    for (int k = 0; k < 3; ++k) {
        const Eigen::Index v = whole.faces(100, k);
        CHECK(kept.contains({whole.vertices(v, 0), whole.vertices(v, 1), whole.vertices(v, 2)}));
    }
}

TEST_CASE("a surface of no more faces than wanted is left alone", "[surface]") {
    const Mesh tube = capsule(0.3, 4);
    const auto same = cluster_vertices(tube, tube.faces.rows());
    CHECK(same.mesh.vertices == tube.vertices);
    CHECK(same.mesh.faces == tube.faces);
    check_way_back(same, tube);
}

TEST_CASE("turned or shuffled, a surface is clustered in the same way", "[surface]") {
    const Mesh fine = three_tubes();
    const Eigen::Index faces = fine.faces.rows() / 6;
    const auto coarse = cluster_vertices(fine, faces);
    REQUIRE(coarse.mesh.faces.rows() < fine.faces.rows() / 4);
    const auto other = cluster_vertices(shuffled(fine, 5), faces);
    CHECK(places_of(other.mesh.vertices) == places_of(coarse.mesh.vertices));
    const auto turned = cluster_vertices(moved(fine, {random_rotation(3), 1.5, Vec3(1, -20, 3)}), faces);
    CHECK(turned.source == coarse.source);
    CHECK(turned.mesh.faces == coarse.mesh.faces);
}

TEST_CASE("a body of many faces is clustered, and names what stands for each vertex of the input", "[surface]") {
    const Mesh tube = capsule(0.3, 4, 300, 300); // 180 thousand faces
    const Mesh open = without_ball(tube, Vec3(0.3, 0, 0), 0.1);
    PrepareOptions few, all;
    few.most_faces = 20000;
    all.most_faces = 0;
    const std::size_t fine_rim = prepare(open, all).rims.at(0).size();
    const Body<double> body = prepare(open, few);
    CHECK(static_cast<double>(body.mesh.faces.rows()) == Approx(10000).epsilon(0.15));
    CHECK(is_closed(body.mesh.faces));
    REQUIRE(body.nearest.size() == static_cast<std::size_t>(open.vertices.rows()));
    const double cell = std::sqrt(1.26 * core::surface_area(open) / 5000);
    for (std::size_t v = 0; v < body.nearest.size(); ++v) {
        if (body.nearest[v] < 0) { // in the hole, where no face has it
            CHECK((core::point(open.vertices, static_cast<Eigen::Index>(v)) - Vec3(0.3, 0, 0)).norm() < 0.11);
            continue;
        }
        const Vec3 there = body.similarity.to_input(core::point(body.mesh.vertices, body.nearest[v]));
        CHECK((there - core::point(open.vertices, static_cast<Eigen::Index>(v))).norm() < 2 * cell);
    }
    for (std::size_t v = 0; v < body.source.size(); ++v) {
        if (body.source[v] < 0) continue;
        const Vec3 place = body.similarity.to_input(core::point(body.mesh.vertices, static_cast<Eigen::Index>(v)));
        CHECK((place - core::point(open.vertices, body.source[v])).norm() < 1e-12);
        CHECK(body.nearest[static_cast<std::size_t>(body.source[v])] == static_cast<int>(v));
    }
    REQUIRE(body.rims.size() == 1);
    CHECK(body.rims.front().size() < fine_rim / 2);
    for (const int v : body.rims.front()) { // around the hole still
        const Vec3 place = body.similarity.to_input(core::point(body.mesh.vertices, v));
        CHECK((place - Vec3(0.3, 0, 0)).norm() == Approx(0.1).margin(2 * cell));
    }
}

TEST_CASE("a large mesh that is not sound or has noise is clustered as it is once that is mended", "[surface]") {
    const Mesh tubes = subdivided(three_tubes(), 1);
    Mesh noisy = tubes, doubled = tubes;
    for (Eigen::Index v = 0; v < noisy.vertices.rows(); ++v)
        noisy.vertices(v, v % 3) += 0.01 * std::sin(static_cast<double>(7 * v * v));
    doubled.faces.conservativeResize(tubes.faces.rows() + 1, 3);
    doubled.faces.bottomRows<1>() = tubes.faces.row(1000);
    REQUIRE_FALSE(is_without_noise(noisy));
    PrepareOptions few;
    few.most_faces = static_cast<int>(tubes.faces.rows() / 3);
    const auto kept = [&](const Mesh& mesh) {
        const std::vector<int> source = prepare(mesh, few).source;
        return std::set<int>(source.begin(), source.end());
    };
    const auto check_same = [&](const Mesh& mesh, const Mesh& mended) {
        const std::set<int> expected = kept(mended);
        CHECK(static_cast<int>(expected.size()) < few.most_faces / 3);
        for (const int threads : {1, 2}) {
            const core::ThreadScope scope(threads);
            const bool is_same = kept(mesh) == expected; // not printed: thousands of numbers
            CHECK(is_same);
        }
    };
    check_same(tubes, tubes);
    check_same(noisy, remove_noise(noisy).mesh);
    check_same(doubled, tubes);
}

TEST_CASE("the regions of a large mesh's curve hold each of its vertices once", "[surface]") {
    const Mesh tube = subdivided(three_tubes(), 1);
    ExtractOptions options;
    options.prepare.most_faces = static_cast<int>(tube.faces.rows() / 3);
    const CurveSkeleton<double> curve = find_curve_skeleton(tube, options);
    std::vector<int> times(static_cast<std::size_t>(tube.vertices.rows()), 0);
    for (const std::vector<int>& region : curve.regions)
        for (const int v : region) ++times[static_cast<std::size_t>(v)];
    CHECK(std::all_of(times.begin(), times.end(), [](int count) { return count == 1; }));
}
