#include <cmath>
#include <limits>
#include <numbers>
#include <type_traits>

#include <skelgen/core/adjacency.hpp>
#include <skelgen/core/error.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/surface/prepare.hpp>

#include "catch.hpp"
#include "mesh_changes.hpp"
#include "shapes.hpp"

using namespace skelgen;
using namespace skelgen::core;
using namespace skelgen::surface;
using namespace skelgen::test;

TEST_CASE("a body is one closed surface of unit area that knows its connectivity and the way back") {
    const Mesh large = moved(torus(1, 0.3), {random_rotation(2), 40, Vec3(1, 2, 3)}), small = sphere(0.1, 2);
    const Mesh mesh = shuffled(side_by_side(small, large), 3);
    const Body<double> body = prepare(mesh);
    CHECK(body.dropped_pieces == 1);
    CHECK(surface_area(body.mesh) == Approx(1).epsilon(1e-3)); // the small piece counts for the scale
    CHECK(is_closed(body.mesh.faces));
    CHECK(body.adjacency == face_adjacency(body.mesh.faces));
    REQUIRE(body.graph.size() == body.mesh.vertices.rows());
    REQUIRE(body.source.size() == static_cast<std::size_t>(body.mesh.vertices.rows()));
    for (Eigen::Index v = 0; v < body.mesh.vertices.rows(); ++v) {
        const Vec3 input = mesh.vertices.row(body.source[static_cast<std::size_t>(v)]);
        REQUIRE((body.similarity.to_input(body.mesh.vertices.row(v).transpose()) - input).norm() < 1e-10);
    }
}

TEMPLATE_TEST_CASE("curves and skeletons go back to the input's coordinates and indices", "", float, double) {
    const Mesh exact = moved(capsule(0.3, 4), {random_rotation(5), 7, Vec3(10, -20, 5)});
    const TriangleMesh<TestType> mesh{exact.vertices.cast<TestType>(), exact.faces};
    const Body<TestType> body = prepare(mesh);
    CurveSkeleton<TestType> curve;
    curve.nodes = body.mesh.vertices.topRows(2);
    curve.edges = {{0, 1}};
    curve.regions = {{0, 2}, {1}};
    curve.radii = {TestType(0.1), TestType(0.2)};
    const CurveSkeleton<TestType> back = to_input(body, curve);
    for (int v = 0; v < 2; ++v)
        CHECK((back.nodes.row(v) - mesh.vertices.row(body.source[static_cast<std::size_t>(v)])).norm() <
              TestType(200) * std::numeric_limits<TestType>::epsilon());
    CHECK(back.regions[0] == std::vector<int>{body.source[0], body.source[2]});
    CHECK(back.radii[1] == Approx(TestType(0.2) * body.similarity.scale));

    KinematicSkeleton<TestType> skeleton;
    skeleton.joints.push_back({"root", -1, curve.nodes.row(0).transpose(), TestType(0.1)});
    skeleton.frame.up = body.similarity.rotation * Vector3<TestType>::UnitX();
    const KinematicSkeleton<TestType> moved_back = to_input(body, skeleton);
    CHECK((moved_back.joints[0].position - back.nodes.row(0).transpose()).norm() == TestType(0));
    CHECK((moved_back.frame.up - Vector3<TestType>::UnitX()).norm() < 10 * std::numeric_limits<TestType>::epsilon());
}

TEST_CASE("a vertex of the input where fans touch goes to one region only") {
    Mesh pinched = sphere(1, 3);
    pinched.faces = (pinched.faces.array() == 3).select(0, pinched.faces);
    const Body<double> body = prepare(pinched);
    CurveSkeleton<double> curve;
    curve.nodes = Points<double>::Zero(2, 3);
    curve.regions.resize(2);
    for (int v = 0; v < body.mesh.vertices.rows(); ++v) curve.regions[static_cast<std::size_t>(v % 2)].push_back(v);
    const CurveSkeleton<double> back = to_input(body, curve);
    CHECK(back.regions[0].size() + back.regions[1].size() == static_cast<std::size_t>(body.mesh.vertices.rows()) - 1);
}

TEST_CASE("the input's vertices are those that faces use, each place once, in its coordinates") {
    Mesh mesh = moved(sphere(1, 2), {Eigen::Matrix3d::Identity(), 3, {5, 1, -2}});
    const Eigen::Index count = mesh.vertices.rows();
    mesh.vertices.conservativeResize(count + 2, 3);
    mesh.vertices.row(count) = mesh.vertices.row(mesh.faces(0, 0)); // the same place twice
    mesh.vertices.row(count + 1).setConstant(99);                   // of no face
    mesh.faces(0, 0) = static_cast<int>(count);
    const Points<double> found = surface::input_vertices(surface::gather(mesh));
    REQUIRE(found.rows() == count);
    for (const auto& place : found.rowwise())
        CHECK((mesh.vertices.topRows(count).rowwise() - place).rowwise().norm().minCoeff() < 1e-6);
}

TEST_CASE("what is no surface is bad input") {
    const auto code = [](const Mesh& mesh) {
        try {
            static_cast<void>(prepare(mesh));
        } catch (const Error& error) {
            return error.code();
        }
        return ErrorCode::internal;
    };
    Mesh mesh = sphere(1, 2);
    mesh.vertices(4, 1) = std::numeric_limits<double>::quiet_NaN();
    CHECK(code(mesh) == ErrorCode::bad_input);
    mesh = sphere(1, 2);
    mesh.faces(3, 0) = static_cast<int>(mesh.vertices.rows());
    CHECK(code(mesh) == ErrorCode::bad_input);
    mesh.faces(3, 0) = -1;
    CHECK(code(mesh) == ErrorCode::bad_input);
    CHECK(code(Mesh{}) == ErrorCode::bad_input);
    CHECK(code(make_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}})) == ErrorCode::bad_input);
}

TEMPLATE_TEST_CASE("very many faces across all of a mesh, and sizes whose cubes are no numbers, are bad input",
                   "[surface]", float, double) {
    // Pages of a book, bound along its height: each is as long as the book.
    const auto book = [](int pages, double size) {
        TriangleMesh<double> mesh{Points<double>(pages + 2, 3), Triangles(pages, 3)};
        mesh.vertices.row(0) << 0, 0, 0;
        mesh.vertices.row(1) << 0, 0, 1;
        for (int i = 0; i < pages; ++i) {
            const double angle = i * 2 * std::numbers::pi / pages;
            mesh.vertices.row(i + 2) << std::cos(angle), std::sin(angle), 0.5;
            mesh.faces.row(i) << 0, 1, i + 2;
        }
        mesh.vertices *= size;
        return TriangleMesh<TestType>{mesh.vertices.template cast<TestType>(), mesh.faces};
    };
    CHECK_NOTHROW(surface::require_surface(book(100, 1)));
    CHECK_THROWS_WITH(surface::require_surface(book(2000, 1)), Catch::Contains("vertices that are far apart"));
    const double rounding = std::numeric_limits<TestType>::min();
    CHECK_THROWS_WITH(surface::require_surface(book(100, std::cbrt(rounding))), Catch::Contains("too small"));
    CHECK_THROWS_WITH(surface::require_surface(book(100, 2 / std::cbrt(rounding))), Catch::Contains("too large"));
    CHECK_NOTHROW(surface::require_surface(book(100, 1e4 * std::cbrt(rounding))));
    CHECK_NOTHROW(surface::require_surface(book(100, 0.1 / std::cbrt(rounding))));
}

TEST_CASE("a place is inside of a body where its surface winds around it, whether or not that is closed") {
    const Body<double> ring = prepare(torus(1, 0.3));
    Mesh cup = cube();
    cup.faces = cup.faces.topRows(cup.faces.rows() - 1).eval();
    const Body<double> open = surface::make_body(cup, {}, std::vector<int>(8, -1), 0);
    REQUIRE(open.adjacency.minCoeff() < 0);
    CHECK(ring.is_closed);
    CHECK_FALSE(open.is_closed);
    for (const Body<double>& body : {ring, open}) {
        const Eigen::RowVector3d low = body.mesh.vertices.colwise().minCoeff();
        const Eigen::RowVector3d size = body.mesh.vertices.colwise().maxCoeff() - low;
        int inside = 0;
        for (int i = 0; i < 125; ++i) {
            const Eigen::RowVector3d at(i % 5 + 0.5, i / 5 % 5 + 0.5, i / 25 + 0.5); // of five parts each way
            const Vec3 place = (low + size.cwiseProduct(at) / 5).transpose();
            const bool is = surface::is_inside(body, place);
            CHECK(is == (core::winding_number(body.mesh, place) > 0.5));
            inside += is ? 1 : 0;
        }
        CHECK(inside > 10);
    }
}
