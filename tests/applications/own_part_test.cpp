#include <skelgen/applications/own_part.hpp>

#include <algorithm>

#include <skelgen/core/geometry.hpp>
#include <skelgen/io/part_looks.hpp>
#include <skelgen/surface/prepare.hpp>

#include "applications/sample_body.hpp"
#include "catch.hpp"
#include "mesh_changes.hpp"

using namespace skelgen;
using namespace skelgen::applications;
using namespace skelgen::test;

namespace {

/// The surface of one of the bodies that stand apart in a mesh, from 1 for the largest.
template <typename Scalar>
Body<Scalar> body_number(const TriangleMesh<Scalar>& mesh, int component) {
    surface::PrepareOptions options;
    options.component = component;
    return *surface::make_body_by(surface::Remedy::largest_piece, surface::gather(mesh, options), options);
}

/// A body, and behind its vertices and faces those of a smaller one beside it.
struct Two {
    TriangleMesh<double> one = sample_mesh(), both;

    Two() {
        TriangleMesh<double> small = one;
        small.vertices *= 0.8;
        small.vertices.col(0).array() += 3;
        both = side_by_side(one, small);
    }
};

} // namespace

TEMPLATE_TEST_CASE("of two bodies the one stays that was found, and knows where it was", "[applications]", float,
                   double) {
    const Two two;
    const TriangleMesh<TestType> mesh{two.both.vertices.template cast<TestType>(), two.both.faces};
    const Eigen::Index n = two.one.vertices.rows(), m = two.one.faces.rows();
    for (const int number : {1, 2}) {
        const auto own = own_body(mesh, body_number(mesh, number));
        const Eigen::Index first = number == 1 ? 0 : n, first_face = number == 1 ? 0 : m;
        CHECK_FALSE(own.part.is_all);
        CHECK(own.mesh.faces == two.one.faces);
        CHECK(own.mesh.vertices == mesh.vertices.middleRows(first, n));
        REQUIRE(own.part.vertices.size() == static_cast<std::size_t>(n));
        REQUIRE(own.part.faces.size() == static_cast<std::size_t>(m));
        for (std::size_t i = 0; i < own.part.vertices.size(); ++i)
            REQUIRE(own.part.vertices[i] == static_cast<int>(first) + static_cast<int>(i));
        for (std::size_t i = 0; i < own.part.faces.size(); ++i)
            REQUIRE(own.part.faces[i] == static_cast<int>(first_face) + static_cast<int>(i));
        int known = 0;
        const TestType size = core::bounding_diagonal(own.mesh.vertices);
        for (std::size_t v = 0; v < own.body.source.size(); ++v) {
            if (own.body.source[v] < 0) continue;
            ++known;
            const Vector3<TestType> there =
                own.body.similarity.to_input(core::point(own.body.mesh.vertices, static_cast<Eigen::Index>(v)));
            CHECK((there - core::point(own.mesh.vertices, own.body.source[v])).norm() < TestType(1e-4) * size);
        }
        CHECK(known > n / 2);
    }
}

TEST_CASE("of a body alone all stays as it is", "[applications]") {
    const TriangleMesh<double> mesh = sample_mesh();
    const Body<double> body = body_number(mesh, 0);
    const auto own = own_body(mesh, body);
    CHECK(own.part.is_all);
    CHECK(own.part.faces.empty());
    CHECK(own.part.vertices.empty());
    CHECK(own.mesh.vertices == mesh.vertices);
    CHECK(own.mesh.faces == mesh.faces);
    CHECK(own.body.source == body.source);
}

TEST_CASE("the looks of a part are those that its vertices and faces had", "[applications]") {
    // Four vertices and two faces of one material, then as many of another; the part is the face 1, 2, 3 of the first
    // and the face 4, 5, 6 of the second.
    io::SceneLooks looks;
    for (const Eigen::Index first : {Eigen::Index{0}, Eigen::Index{4}}) {
        io::ScenePart part;
        part.first_vertex = first, part.vertices = 4;
        part.first_face = first / 2, part.faces = 2;
        part.material = static_cast<std::size_t>(first / 4);
        part.texture_coordinates.emplace_back(4, 2);
        for (int v = 0; v < 4; ++v)
            part.texture_coordinates[0].row(v) << static_cast<float>(first + v), static_cast<float>(first);
        looks.parts.push_back(part);
    }
    OwnPart part;
    part.is_all = false;
    part.faces = {1, 2};
    part.vertices = {1, 2, 3, 4, 5, 6};
    const io::SceneLooks own = io::looks_of(looks, part);
    REQUIRE(own.parts.size() == 2);
    CHECK(own.parts[0].first_vertex == 0);
    CHECK(own.parts[0].vertices == 3);
    CHECK(own.parts[0].first_face == 0);
    CHECK(own.parts[0].faces == 1);
    CHECK(own.parts[0].texture_coordinates[0].col(0) == Eigen::Vector3f(1, 2, 3));
    CHECK(own.parts[1].first_vertex == 3);
    CHECK(own.parts[1].vertices == 3);
    CHECK(own.parts[1].first_face == 1);
    CHECK(own.parts[1].faces == 1);
    CHECK(own.parts[1].material == std::size_t{1});
    CHECK(own.parts[1].texture_coordinates[0].col(0) == Eigen::Vector3f(4, 5, 6));
    CHECK(io::looks_of(looks, OwnPart{}).parts[0].vertices == 4);
}
