#include <limits>
#include <string>

#include <skelgen/core/error.hpp>
#include <skelgen/extract.hpp>
#include <skelgen/io/template_json.hpp>

#include "catch.hpp"
#include "fixture_bodies.hpp"
#include "mesh_changes.hpp"
#include "shapes.hpp"

using namespace skelgen;
using namespace skelgen::test;

namespace {

ErrorCode error_of(const Mesh& mesh, const ExtractOptions& options = {}) {
    try {
        static_cast<void>(extract_skeleton(mesh, options));
    } catch (const Error& error) {
        CHECK(std::string(error.what()).size() > 10);
        return error.code();
    }
    return ErrorCode::internal;
}

} // namespace

TEST_CASE("what is no usable surface is bad input") {
    CHECK(error_of(Mesh{Points<double>(0, 3), Triangles(0, 3)}) == ErrorCode::bad_input);
    CHECK(error_of(Mesh{sphere(1).vertices, Triangles(0, 3)}) == ErrorCode::bad_input);
    CHECK(error_of(make_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}})) == ErrorCode::bad_input);

    Mesh flat = sphere(1);
    flat.vertices.rightCols<2>().setZero();
    CHECK(error_of(flat) == ErrorCode::bad_input);
    Mesh point = sphere(1);
    point.vertices.setConstant(1);
    CHECK(error_of(point) == ErrorCode::bad_input);
}

TEST_CASE("a coordinate that is no finite number is bad input") {
    for (const double value : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                               -std::numeric_limits<double>::infinity()}) {
        Mesh mesh = sphere(1);
        mesh.vertices(17, 1) = value;
        CHECK(error_of(mesh) == ErrorCode::bad_input);
    }
}

TEST_CASE("a face with a vertex that does not exist is bad input") {
    for (const int index : {-1, static_cast<int>(sphere(1).vertices.rows()), std::numeric_limits<int>::max()}) {
        Mesh mesh = sphere(1);
        mesh.faces(11, 2) = index;
        CHECK(error_of(mesh) == ErrorCode::bad_input);
    }
}

TEST_CASE("faces that all repeat a vertex are bad input") {
    Mesh mesh = sphere(1, 1);
    mesh.faces.col(1) = mesh.faces.col(0);
    CHECK(error_of(mesh) == ErrorCode::bad_input);
}

TEST_CASE("a sphere, a torus, a cube, a tetrahedron and a Y are no bodies") {
    CHECK(error_of(sphere(1, 4)) == ErrorCode::no_skeleton);
    CHECK_THROWS_WITH(extract_skeleton(sphere(1, 4)), Catch::Contains("too compact")); // its curve is a point
    CHECK(error_of(torus(1, 0.3)) == ErrorCode::no_skeleton);
    CHECK(error_of(cube()) == ErrorCode::no_skeleton);
    CHECK(error_of(cube(4)) == ErrorCode::no_skeleton);
    CHECK(error_of(make_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                             {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}})) == ErrorCode::no_skeleton);
    CHECK(error_of(three_tubes()) == ErrorCode::no_skeleton);
    CHECK(error_of(capsule(0.2, 4)) == ErrorCode::no_skeleton);
}

TEST_CASE(
    "furniture, animals, parts of a body and two bodies at once are refused, or answered as the guess that it is") {
    const std::vector<std::filesystem::path> objects = fixture_objects();
    REQUIRE(objects.size() == 9);
    for (const std::filesystem::path& object : objects) {
        INFO(object);
        try {
            const Quality quality = extract(io::read_mesh<double>(object)).skeleton.quality;
            CHECK(quality.sides_confidence < 0.5);
            CHECK_FALSE(quality.warnings.empty());
        } catch (const NoSkeleton& refused) {
            CHECK(refused.refusal() != Refusal::none);
        }
    }
}

TEST_CASE("a flat sheet and a soup of separate triangles are refused, not crashed on") {
    Mesh sheet = box({1, 1, 1}, 4);
    sheet.vertices.col(2).setZero();
    const ErrorCode of_sheet = error_of(sheet);
    CHECK((of_sheet == ErrorCode::bad_input || of_sheet == ErrorCode::no_skeleton));

    const Mesh whole = sphere(1, 2);
    Mesh soup{Points<double>(3 * whole.faces.rows(), 3), whole.faces};
    for (Eigen::Index f = 0; f < whole.faces.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            soup.vertices.row(3 * f + k) = whole.vertices.row(whole.faces(f, k));
            soup.faces(f, k) = static_cast<int>(3 * f + k);
        }
    const ErrorCode of_soup = error_of(soup);
    CHECK((of_soup == ErrorCode::bad_input || of_soup == ErrorCode::no_skeleton));
}

TEST_CASE("a template that breaks the rules is bad input") {
    ExtractOptions options;
    options.skeleton_template = builtin_template("human21");
    options.skeleton_template.joints.pop_back();
    CHECK(error_of(sphere(1), options) == ErrorCode::bad_input);
}
