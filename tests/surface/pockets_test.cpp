#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <skelgen/core/geometry.hpp>
#include <skelgen/surface/pockets.hpp>
#include <skelgen/surface/prepare.hpp>

#include "catch.hpp"
#include "mesh_changes.hpp"
#include "shapes.hpp"

using namespace skelgen;
using namespace skelgen::core;
using namespace skelgen::surface;
using namespace skelgen::test;

namespace {

constexpr double mouth = 0.04, cavity = 0.1;

/// A ball of radius 1 with a ball-shaped cavity of radius `cavity` in it, to which a channel leads from its top.
Mesh flask() {
    constexpr int steps = 60, inner_steps = 16;
    std::vector<std::array<double, 2>> profile{{0, -1}};
    for (int i = 1; i < steps; ++i) {
        const double angle = pi * i / steps;
        if (std::sin(angle) > mouth || angle < pi / 2) profile.push_back({std::sin(angle), -std::cos(angle)});
    }
    const double middle = 0.75, entrance = std::sqrt(cavity * cavity - mouth * mouth);
    for (int i = 0; i <= 5; ++i) profile.push_back({mouth, std::lerp(0.995, middle + entrance, i / 5.0)});
    const double first = std::asin(mouth / cavity);
    for (int i = 1; i < inner_steps; ++i) {
        const double angle = std::lerp(first, pi, static_cast<double>(i) / inner_steps);
        profile.push_back({cavity * std::sin(angle), middle + cavity * std::cos(angle)});
    }
    profile.push_back({0, middle - cavity});
    return surface_of_revolution(profile, 64);
}

/// A ball of radius 1 with a well in its top, from whose floor a narrower pit leads on.
Mesh well_with_a_pit() {
    constexpr int steps = 60, inner_steps = 16;
    constexpr double well = 0.085, floor = 0.7, pit_mouth = 0.035, pit = 0.055;
    std::vector<std::array<double, 2>> profile{{0, -1}};
    for (int i = 1; i < steps; ++i) {
        const double angle = pi * i / steps;
        if (std::sin(angle) > well || angle < pi / 2) profile.push_back({std::sin(angle), -std::cos(angle)});
    }
    for (int i = 0; i <= 8; ++i) profile.push_back({well, std::lerp(0.99, floor, i / 8.0)});
    for (int i = 1; i <= 3; ++i) profile.push_back({std::lerp(well, pit_mouth, i / 3.0), floor});
    const double middle = floor - std::sqrt(pit * pit - pit_mouth * pit_mouth), first = std::asin(pit_mouth / pit);
    for (int i = 1; i < inner_steps; ++i) {
        const double angle = std::lerp(first, pi, static_cast<double>(i) / inner_steps);
        profile.push_back({pit * std::sin(angle), middle + pit * std::cos(angle)});
    }
    profile.push_back({0, middle - pit});
    return surface_of_revolution(profile, 64);
}

/// The faces of a mesh that lie above a height with all corners.
Mesh above(const Mesh& mesh, double height) {
    Mesh out{mesh.vertices, Triangles(mesh.faces.rows(), 3)};
    Eigen::Index count = 0;
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
        double lowest = mesh.vertices(mesh.faces(f, 0), 2);
        for (int k = 1; k < 3; ++k) lowest = std::min(lowest, mesh.vertices(mesh.faces(f, k), 2));
        if (lowest > height) out.faces.row(count++) = mesh.faces.row(f);
    }
    out.faces.conservativeResize(count, 3);
    return out;
}

/// A ball of radius 1 with half a ball of radius `cavity` cut out of its top.
Mesh dented() {
    const auto field = [](const Vec3& p) { return std::max(p.norm() - 1, cavity - (p - Vec3(0, 0, 1)).norm()); };
    return level_set(field, Vec3::Constant(-1.1), Vec3::Constant(1.1), 0.04);
}

/// Two long bars side by side that meet at one end, as legs do.
Mesh two_bars() {
    return tubes({{Vec3(-0.15, 0, 0), Vec3(-0.15, 0, 2)},
                  {Vec3(0.15, 0, 0), Vec3(0.15, 0, 2)},
                  {Vec3(-0.15, 0, 0), Vec3(0.15, 0, 0)}},
                 0.12, 0.03);
}

} // namespace

TEMPLATE_TEST_CASE("a flask's cavity is closed, and nothing else of it moves", "", float, double) {
    const Mesh exact = flask();
    const TriangleMesh<TestType> given{exact.vertices.cast<TestType>(), exact.faces};
    const Body<TestType> body = prepare(given);
    const auto closed = close_pockets(body);
    REQUIRE(closed);
    CHECK(is_closed(closed->mesh.faces));
    CHECK(closed->repairs == std::vector<std::string>{"cavities closed: 1"});
    const double size = static_cast<double>(body.similarity.scale); // of the input's unit in the body's
    const double hollow = 4.0 / 3 * pi * std::pow(cavity, 3);       // and some of the channel
    const double gained =
        std::pow(size, 3) * static_cast<double>(enclosed_volume(closed->mesh) - enclosed_volume(body.mesh));
    CHECK(gained > 0.97 * hollow);
    CHECK(gained < 1.5 * hollow);
    REQUIRE(closed->source.size() == static_cast<std::size_t>(closed->mesh.vertices.rows()));
    for (std::size_t v = 0; v < closed->source.size(); ++v) {
        if (closed->source[v] < 0) continue;
        const Vector3<TestType> was = body.similarity.to_canonical(point(given.vertices, closed->source[v]));
        CHECK((was - point(closed->mesh.vertices, static_cast<Eigen::Index>(v))).norm() < 1e-5);
    }
}

TEST_CASE("of a flask turned, scaled and shuffled the same is closed") {
    const Body<double> body = prepare(flask());
    const auto changed = prepare(shuffled(moved(flask(), {random_rotation(3), 20, Vec3(1, 2, 3)}), 7));
    const auto one = close_pockets(body), other = close_pockets(changed);
    REQUIRE(one);
    REQUIRE(other);
    CHECK(one->mesh.faces.rows() == other->mesh.faces.rows());
    CHECK(std::abs(enclosed_volume(one->mesh) - enclosed_volume(other->mesh)) < 1e-9);
}

TEST_CASE("where a body is open otherwise it stays open when its pockets are closed") {
    const Body<double> body = prepare(above(flask(), -0.8));
    const auto open_edges = [](const Body<double>& each) { return (each.adjacency.array() < 0).count(); };
    REQUIRE(open_edges(body) == 64); // the ring around
    const auto closed = close_pockets(body);
    REQUIRE(closed);
    CHECK(closed->repairs.back() == "cavities closed: 1");
    CHECK(closed->mesh.faces.rows() < body.mesh.faces.rows());
    CHECK(open_edges(*closed) == 64);
}

TEST_CASE("a pit in the floor of a pocket is no pocket of its own") {
    const auto closed = close_pockets(prepare(well_with_a_pit()));
    REQUIRE(closed);
    CHECK(is_closed(closed->mesh.faces));
    CHECK(closed->repairs == std::vector<std::string>{"cavities closed: 1"});
}

TEST_CASE("dents, gaps between bars and what has none are no pockets") {
    CHECK_FALSE(close_pockets(prepare(sphere(1))));
    CHECK_FALSE(close_pockets(prepare(dented())));
    CHECK_FALSE(close_pockets(prepare(two_bars())));
    CHECK_FALSE(close_pockets(prepare(torus(1, 0.2))));
    CHECK_FALSE(close_pockets(prepare(three_tubes())));
}
