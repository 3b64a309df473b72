#include <skelgen/surface/rounded.hpp>

#include <cmath>
#include <string>

#include <skelgen/core/geometry.hpp>
#include <skelgen/surface/prepare.hpp>

#include "catch.hpp"
#include "mesh_changes.hpp"
#include "shapes.hpp"

using namespace skelgen;
using namespace skelgen::surface;
using namespace skelgen::test;

TEMPLATE_TEST_CASE("a coarse ball becomes rounder, and its vertices stay", "[surface]", float, double) {
    const Mesh ball = sphere(1, 0); // all edges of one length, all normals radial
    const TriangleMesh<TestType> coarse{ball.vertices.cast<TestType>(), ball.faces};
    const TriangleMesh<TestType> round = rounded(coarse);
    REQUIRE(round.faces.rows() == 4 * coarse.faces.rows());
    REQUIRE(round.vertices.topRows(coarse.vertices.rows()) == coarse.vertices);
    CHECK(is_closed(round.faces));
    // Over a chord that spans the angle 2 h: cos h (1 + sin^2 h / 2), where the chord's own middle is at cos h.
    const double cosine = ball.vertices.row(ball.faces(0, 0)).dot(ball.vertices.row(ball.faces(0, 1)));
    const double height = std::sqrt((1 + cosine) / 2) * (1 + (1 - cosine) / 4);
    for (Eigen::Index v = coarse.vertices.rows(); v < round.vertices.rows(); ++v)
        CHECK(round.vertices.row(v).norm() == Approx(height).epsilon(1e-5));
}

TEST_CASE("a flat surface stays flat, with its edges halved", "[surface]") {
    const Mesh flat = make_mesh({{0, 0, 1}, {2, 0, 1}, {0, 2, 1}}, {{0, 1, 2}});
    const Mesh finer = rounded(flat);
    REQUIRE(finer.vertices.rows() == 6);
    CHECK(finer.vertices.col(2) == Eigen::VectorXd::Ones(6));
    CHECK(core::surface_area(finer) == Approx(2).epsilon(1e-15));
}

TEST_CASE("a rounded body's vertices are those of the input, but for new ones", "[surface]") {
    const Mesh tube = without_faces(capsule(0.3, 4, 12, 10), 30, 1);
    const BodyMaterial<double> material = gather(tube);
    REQUIRE(material.remedies == std::vector<Remedy>{Remedy::largest_piece, Remedy::rounded});
    const Outcome<Body<double>> body = make_body_by(Remedy::rounded, material);
    REQUIRE(body);
    CHECK(is_closed(body->mesh.faces));
    CHECK(body->repairs.back() == "coarse surface made rounder: " + std::to_string(4 * (tube.faces.rows() + 1)) +
                                      " faces of " + std::to_string(tube.faces.rows() + 1));
    int kept = 0;
    for (std::size_t v = 0; v < body->source.size(); ++v) {
        if (body->source[v] < 0) continue;
        ++kept;
        const Vec3 place = body->similarity.to_input(core::point(body->mesh.vertices, static_cast<Eigen::Index>(v)));
        CHECK((place - core::point(tube.vertices, body->source[v])).norm() < 1e-6); // rounded as it was put right
    }
    CHECK(kept == tube.vertices.rows());
}
