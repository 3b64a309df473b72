#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <string>
#include <vector>

#include <skelgen/core/error.hpp>
#include <skelgen/io/polygon_mesh.hpp>

#include "catch.hpp"

using namespace skelgen;
using namespace skelgen::io;
using Catch::Matchers::Contains;

namespace {

using Outline = std::vector<std::array<double, 2>>;

/// One polygon in a tilted plane.
PolygonMesh one_polygon(const Outline& outline, double scale = 1) {
    PolygonMesh mesh;
    for (const auto& [x, y] : outline) {
        mesh.corners.push_back(static_cast<int>(mesh.corners.size()));
        mesh.coordinates.insert(mesh.coordinates.end(), {scale * x, scale * y, scale * (0.5 * x - 2 * y)});
    }
    mesh.sizes.push_back(static_cast<int>(outline.size()));
    return mesh;
}

double signed_area(const std::array<double, 2>& a, const std::array<double, 2>& b, const std::array<double, 2>& c) {
    return ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2;
}

/// A triangulation of an outline: no triangle is turned over, and the areas add up (so that none overlap).
void check_covers_once(const Outline& outline, double scale = 1) {
    const Triangles faces = triangulate(one_polygon(outline, scale)).faces;
    const auto n = static_cast<Eigen::Index>(outline.size());
    REQUIRE(faces.rows() == n - 2);
    const auto at = [&](Eigen::Index i, int k) { return outline[static_cast<std::size_t>(faces(i, k))]; };
    double sum = 0, expected = 0;
    for (Eigen::Index i = 0; i < n - 2; ++i) {
        const double area = signed_area(at(i, 0), at(i, 1), at(i, 2));
        CHECK(area > -1e-12);
        sum += area;
    }
    for (std::size_t i = 1; i + 1 < outline.size(); ++i)
        expected += signed_area(outline[0], outline[i], outline[i + 1]);
    CHECK(sum == Approx(expected));
}

std::string error_of(const PolygonMesh& mesh) {
    try {
        static_cast<void>(triangulate(mesh));
    } catch (const Error& error) {
        CHECK(error.code() == ErrorCode::bad_input);
        return error.what();
    }
    return "no error";
}

} // namespace

TEST_CASE("triangulate: a quad is cut along its shorter diagonal", "[io][polygons]") {
    Triangles expected(2, 3);
    expected << 3, 0, 1, 3, 1, 2; // diagonal 1-3
    CHECK(triangulate(one_polygon({{0, 0}, {2, -0.5}, {4, 0}, {2, 0.5}})).faces == expected);
    const Triangles other = triangulate(one_polygon({{0, 0}, {0.5, -3}, {1, 0}, {0.5, 3}})).faces;
    CHECK(std::set<int>{other(0, 0), other(0, 1), other(0, 2)}.count(0) == 1);
    CHECK(std::set<int>{other(0, 0), other(0, 1), other(0, 2)}.count(2) == 1);
}

TEST_CASE("triangulate: concave polygons are covered once", "[io][polygons]") {
    const Outline arrow{{0, 0}, {4, -3}, {1, 0}, {4, 3}}; // the shorter diagonal runs outside
    const Outline comb{{0, 0}, {7, 0}, {7, 5}, {6, 5}, {6, 1}, {5, 1}, {5, 5}, {4, 5}, {4, 1}, {1, 1}, {1, 5}, {0, 5}};
    const Outline with_straight_corners{{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}};
    for (const double scale : {1e-200, 1e-8, 1.0, 1e8, 1e200}) {
        check_covers_once(arrow, scale);
        check_covers_once(comb, scale);
        check_covers_once(with_straight_corners, scale);
    }
    for (std::size_t turn = 0; turn < 4; ++turn) {
        Outline turned = arrow;
        std::rotate(turned.begin(), turned.begin() + static_cast<std::ptrdiff_t>(turn), turned.end());
        check_covers_once(turned);
    }
}

TEST_CASE("triangulate: random star-shaped polygons are covered once", "[io][polygons]") {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> radius(0.1, 1);
    for (int trial = 0; trial < 50; ++trial) {
        const int corners = 4 + trial;
        Outline star;
        for (int i = 0; i < corners; ++i) {
            const double angle = 2 * 3.14159265358979 * i / corners, r = radius(random);
            star.push_back({r * std::cos(angle), r * std::sin(angle)});
        }
        check_covers_once(star);
    }
}

TEST_CASE("triangulate: a slit that leads to a hole", "[io][polygons]") {
    // A square of 4 x 4 with a hole of 2 x 2; corners 0 and 4 are each visited twice.
    PolygonMesh mesh = one_polygon({{0, 0}, {4, 0}, {4, 4}, {0, 4}, {1, 1}, {1, 3}, {3, 3}, {3, 1}});
    mesh.corners = {0, 1, 2, 3, 0, 4, 5, 6, 7, 4};
    mesh.sizes = {10};
    const TriangleMesh<double> result = triangulate(mesh);
    double area = 0;
    for (Eigen::Index i = 0; i < result.faces.rows(); ++i) {
        const auto at = [&](int k) { return Eigen::Vector3d(result.vertices.row(result.faces(i, k))); };
        area += (at(1) - at(0)).cross(at(2) - at(0))[2] / 2;
    }
    CHECK(result.faces.rows() == 8);
    CHECK(area == Approx(12));
}

TEST_CASE("triangulate: polygons without area or plane still give their triangles", "[io][polygons]") {
    CHECK(triangulate(one_polygon({{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}})).faces.rows() == 3);
    CHECK(triangulate(one_polygon({{1, 1}, {1, 1}, {1, 1}, {1, 1}})).faces.rows() == 2);
    CHECK(triangulate(one_polygon({{0, 0}, {1, 1}, {1, 0}, {0, 1}})).faces.rows() == 2); // a bow tie
}

TEST_CASE("triangulate: vertices that repeat", "[io][polygons]") {
    PolygonMesh mesh = one_polygon({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
    mesh.corners = {0, 1, 1, 2, /**/ 0, 1, 1, /**/ 3, 3, 3, 3, /**/ 0, 2, 3};
    mesh.sizes = {4, 3, 4, 3};
    Triangles expected(2, 3);
    expected << 0, 1, 2, 0, 2, 3;
    CHECK(triangulate(mesh).faces == expected);
}

TEST_CASE("triangulate: unused vertices, pinched ones and crowded edges stay", "[io][polygons]") {
    PolygonMesh mesh;
    mesh.coordinates.assign(3 * 8, 0.0);
    for (std::size_t i = 0; i < mesh.coordinates.size(); ++i) mesh.coordinates[i] = static_cast<double>(i * i % 7);
    mesh.corners = {0, 1, 2, 0, 3, 4, 0, 1, 5, 1, 0, 6, 0, 1, 2}; // 7 is unused, the last face a duplicate
    mesh.sizes = {3, 3, 3, 3, 3};
    const TriangleMesh<float> result = triangulate<float>(mesh);
    CHECK(result.vertices.rows() == 8);
    CHECK(result.faces == Eigen::Map<const Triangles>(mesh.corners.data(), 5, 3));
}

TEST_CASE("triangulate: a circle of many corners takes no noticeable time", "[io][polygons]") {
    Outline circle;
    for (int i = 0; i < 2000; ++i) circle.push_back({std::cos(i * 0.00314159), std::sin(i * 0.00314159)});
    CHECK(triangulate(one_polygon(circle)).faces.rows() == 1998);
}

TEST_CASE("triangulate: bad polygons are refused", "[io][polygons]") {
    const PolygonMesh good = one_polygon({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
    CHECK(error_of(good) == "no error");
    PolygonMesh bad = good;
    bad.corners[2] = 4;
    CHECK_THAT(error_of(bad), Contains("vertex 4"));
    bad.corners[2] = -1;
    CHECK_THAT(error_of(bad), Contains("vertex -1"));
    bad = good;
    bad.sizes = {2, 2};
    CHECK_THAT(error_of(bad), Contains("2 corners"));
    bad.sizes = {3};
    CHECK_THAT(error_of(bad), Contains("add up to 3"));
    bad.sizes = {};
    CHECK_THAT(error_of(bad), Contains("no faces"));
    PolygonMesh costly; // each could be read, but all would take a minute
    costly.coordinates = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    costly.sizes.assign(40, max_face_corners);
    costly.corners.assign(std::size_t{40} * max_face_corners, 0);
    CHECK_THAT(error_of(costly), Contains("hundreds of corners"));
    bad.sizes = {max_face_corners + 1};
    CHECK_THAT(error_of(bad), Contains("10001 corners"));
    bad = good;
    bad.coordinates.clear();
    CHECK_THAT(error_of(bad), Contains("no vertices"));
    bad = good;
    bad.coordinates[5] = std::numeric_limits<double>::quiet_NaN();
    CHECK_THAT(error_of(bad), Contains("not a number"));
}
