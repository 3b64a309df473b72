#include <skelgen/applications/correspondence.hpp>

#include <cmath>
#include <numbers>
#include <set>

#include <skelgen/applications/body_coordinates.hpp>
#include <skelgen/applications/impl/bones.hpp>
#include <skelgen/applications/pose_transfer.hpp>
#include <skelgen/applications/posing.hpp>
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
    const auto& [mesh, a, skeleton, body] = sample_body();
    const Extraction<double> b = extract(moved(mesh, {random_rotation(4), 10, Vector3<double>(1, 2, 3)}));
    CorrespondenceOptions few;
    few.first_functions = 40;
    few.functions = 60;
    const ComparableBody<double> from = comparable(body, skeleton, few);
    const ComparableBody<double> to = comparable(b.body, b.skeleton, few);
    const Correspondence found = correspond(from, to, few);
    REQUIRE(found.map.size() == static_cast<std::size_t>(body.mesh.vertices.rows()));
    REQUIRE(found.confidence.size() == found.map.size());
    double sum = 0, sure = 0;
    for (std::size_t v = 0; v < found.map.size(); ++v) {
        // Both bodies were made of the same mesh: vertices come from the same ones of it.
        const Vector3<double> place = core::point(mesh.vertices, body.source[v]);
        const Vector3<double> other = core::point(mesh.vertices, b.body.source[static_cast<std::size_t>(found.map[v])]);
        sum += (place - other).norm();
        sure += found.confidence[v];
        REQUIRE(found.confidence[v] >= 0);
        REQUIRE(found.confidence[v] <= 1);
    }
    const auto n = static_cast<double>(found.map.size());
    CHECK(sum / n < 0.002); // metres
    CHECK(sure / n > 0.98);

    const TriangleMesh<double> other = moved(mesh, {random_rotation(4), 10, Vector3<double>(1, 2, 3)});
    const std::vector<TrianglePlace> places = triangle_places(other, b.body, to, found);
    REQUIRE(places.size() == found.map.size());
    double between = 0;
    for (std::size_t v = 0; v < places.size(); ++v) {
        Vector3<double> place = Vector3<double>::Zero();
        double all = 0;
        for (int i = 0; i < 3; ++i) {
            const double weight = places[v].weights[static_cast<std::size_t>(i)];
            CHECK(weight >= 0);
            all += weight;
            place += weight * core::point(mesh.vertices, other.faces(places[v].face, i));
        }
        CHECK(all == Approx(1));
        between += (place - core::point(mesh.vertices, body.source[v])).norm();
    }
    CHECK(between / n < 0.002); // metres

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

TEST_CASE("correspondence: places between vertices are nearer than vertices of a coarse body", "[applications]") {
    const auto& [mesh, a, skeleton, body] = sample_body();
    CorrespondenceOptions few;
    few.first_functions = 40;
    few.functions = 60;
    const TriangleMesh<double> coarse = read_mesh<double>(SKELGEN_DATA "/sample/body.off"); // every vertex, but moved
    Correspondence found;
    const ComparableBody<double> own = comparable(body, skeleton, few);
    // As if each vertex came to lie in the middle of the first triangle at it.
    std::vector<int> first(static_cast<std::size_t>(own.common.rows()), -1);
    for (int f = 0; f < own.faces.rows(); ++f)
        for (int i = 0; i < 3; ++i)
            if (int& face = first[static_cast<std::size_t>(own.faces(f, i))]; face < 0) face = f;
    found.bent.resize(own.common.rows(), 3);
    for (int v = 0; v < own.common.rows(); ++v) {
        const auto corners = own.faces.row(first[static_cast<std::size_t>(v)]);
        found.map.push_back(v);
        found.bent.row(v) =
            (own.common.row(corners[0]) + own.common.row(corners[1]) + own.common.row(corners[2])) / 3.0;
    }
    const std::vector<TrianglePlace> places = triangle_places(coarse, body, own, found);
    const std::vector<int> stands_for = standing_for(body, coarse.vertices);
    for (std::size_t v = 0; v < places.size(); ++v) {
        Vector3<double> place = Vector3<double>::Zero();
        for (int i = 0; i < 3; ++i)
            place += places[v].weights[static_cast<std::size_t>(i)] *
                     core::point(own.common, stands_for[static_cast<std::size_t>(coarse.faces(places[v].face, i))]);
        REQUIRE((place - core::point(found.bent, static_cast<Eigen::Index>(v))).norm() < 1e-9);
    }
}

TEST_CASE("correspondence: a body corresponds to itself in another pose", "[applications]") {
    const auto& [mesh, a, skeleton, body] = sample_body();
    const SkeletonTemplate& human = builtin_template("human21");
    // At rest, with arms level, and turned: every vertex is known to be where its own is.
    const auto rest = rest_skeleton<double>(human);
    const Orientations<double> upright(rest.joints.size(), Eigen::Quaterniond::Identity());
    const Orientations<double> whole(rest.joints.size(), Eigen::Quaterniond(random_rotation(8)));
    const auto turned = applications::moved(rest, human, motions<double>(rest, upright, whole, {1, 2, 3}));
    const TriangleMesh<double> posed = pose_like(mesh, body, skeleton, turned, human).mesh;
    const Extraction<double> b = extract(posed);
    const ComparableBody<double> from = comparable(body, skeleton);
    const ComparableBody<double> to = comparable(b.body, b.skeleton);
    const Correspondence found = correspond(from, to);

    const std::vector<int> own = first_standing(b.body, standing_for(b.body, posed.vertices));
    double sum = 0;
    int exchanged = 0;
    for (std::size_t v = 0; v < found.map.size(); ++v) {
        const int there = own[static_cast<std::size_t>(found.map[v])];
        REQUIRE(there >= 0);
        sum += (core::point(mesh.vertices, body.source[v]) - core::point(mesh.vertices, there)).norm();
        exchanged += from.sides[static_cast<Eigen::Index>(v)] * to.sides[found.map[v]] < -0.5 ? 1 : 0;
    }
    CHECK(sum / static_cast<double>(found.map.size()) < 0.03); // metres
    CHECK(exchanged == 0);
}
