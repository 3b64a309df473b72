#include <skelgen/applications/correspondence.hpp>

#include <cmath>
#include <numbers>
#include <set>

#include <skelgen/applications/body_coordinates.hpp>
#include <skelgen/core/error.hpp>
#include <skelgen/core/geometry.hpp>

#include "applications/sample_body.hpp"
#include "catch.hpp"
#include "mesh_changes.hpp"
#include "shapes.hpp"

using namespace skelgen;
using namespace skelgen::applications;
using namespace skelgen::test;

TEMPLATE_TEST_CASE("laplace basis: the harmonics of a sphere", "[applications]", float, double) {
    using Scalar = TestType;
    const Mesh sphere = test::sphere(2, 4);
    const TriangleMesh<Scalar> mesh{sphere.vertices.cast<Scalar>(), sphere.faces};
    const LaplaceBasis basis = laplace_basis(mesh, 16);
    REQUIRE(basis.values.size() == 16);
    // l (l + 1) / r^2, each 2 l + 1 times.
    int i = 0;
    for (int l = 0; l < 4; ++l)
        for (int m = 0; m < 2 * l + 1; ++m)
            CHECK(basis.values[i++] == Approx(l * (l + 1) / 4.0).epsilon(0.02).margin(1e-3));
    CHECK(basis.areas.sum() == Approx(4 * std::numbers::pi * 4).epsilon(0.01));
    const Eigen::MatrixXd gram = basis.functions.transpose() * basis.areas.asDiagonal() * basis.functions;
    CHECK((gram - Eigen::MatrixXd::Identity(16, 16)).cwiseAbs().maxCoeff() < 1e-6);
    CHECK_THROWS_AS(laplace_basis(mesh, 0), Error);
    CHECK_THROWS_AS(laplace_basis(mesh, static_cast<int>(mesh.vertices.rows())), Error);
}

TEST_CASE("correspondence: a body turned and shuffled corresponds to itself", "[applications]") {
    const TriangleMesh<double> mesh = sample_mesh();
    const TriangleMesh<double> turned = moved(mesh, {random_rotation(4), 10, Vector3<double>(1, 2, 3)});
    const FittedBody<double> a = extract_body(mesh), b = extract_body(turned);
    CorrespondenceOptions few;
    few.first_functions = 40;
    few.functions = 60;
    const ComparableBody<double> from = comparable(a.body, a.extraction.skeleton, few);
    const ComparableBody<double> to = comparable(b.body, b.extraction.skeleton, few);
    const Correspondence found = correspond(from, to, few);
    REQUIRE(found.map.size() == static_cast<std::size_t>(a.body.mesh.vertices.rows()));
    REQUIRE(found.confidence.size() == found.map.size());
    double sum = 0, sure = 0;
    for (std::size_t v = 0; v < found.map.size(); ++v) {
        // Both bodies were made of the same mesh: vertices come from the same ones of it.
        const Vector3<double> place = core::point(mesh.vertices, a.body.source[v]);
        const Vector3<double> other = core::point(mesh.vertices, b.body.source[static_cast<std::size_t>(found.map[v])]);
        sum += (place - other).norm();
        sure += found.confidence[v];
        REQUIRE(found.confidence[v] >= 0);
        REQUIRE(found.confidence[v] <= 1);
    }
    const auto n = static_cast<double>(found.map.size());
    CHECK(sum / n < 0.002); // metres
    CHECK(sure / n > 0.98);

    const std::vector<Landmark> marks = landmarks(from, found);
    CHECK(marks.size() == part_names(PartSet::bones).size());
    std::set<std::string> names;
    for (const Landmark& mark : marks) {
        INFO(mark.name);
        names.insert(mark.name);
        CHECK(from.parts.parts[static_cast<std::size_t>(from.parts.vertex_part[static_cast<std::size_t>(mark.from)])] ==
              mark.name);
        CHECK(to.parts.parts[static_cast<std::size_t>(to.parts.vertex_part[static_cast<std::size_t>(mark.to)])] ==
              mark.name);
    }
    CHECK(names.size() == marks.size());

    few.functions = 100; // more than the bodies were made with
    CHECK_THROWS_AS(correspond(from, to, few), Error);
    few.functions = 30; // fewer than it begins with
    CHECK_THROWS_WITH(correspond(from, to, few), Catch::Matchers::Contains("correspondence.functions"));
    for (const double bad : {-1.0, 3.0}) {
        CorrespondenceOptions options;
        options.posture = bad;
        CHECK_THROWS_WITH(correspond(from, to, options), Catch::Matchers::Contains("correspondence.posture"));
    }
}
