#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>

#include <skelgen/core/adjacency.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/surface/contours.hpp>

#include "catch.hpp"
#include "mesh_changes.hpp"
#include "shapes.hpp"

using namespace skelgen;
using namespace skelgen::core;
using namespace skelgen::surface;
using namespace skelgen::test;

namespace {

/// A mesh and what questions about its contours need.
struct Surface {
    explicit Surface(Mesh m) : mesh(std::move(m)), adjacency(face_adjacency(mesh.faces)), tree(mesh) {}

    [[nodiscard]] std::vector<Contour<double>> cut(const Vec3& normal, double offset) const {
        return LevelSets<double>(mesh, adjacency, mesh.vertices * normal).contours(offset);
    }
    [[nodiscard]] std::optional<Contour<double>> around(const Vec3& place, const Vec3& normal, double reach) const {
        return contour_around(mesh, adjacency, tree, place, normal, reach);
    }

    Mesh mesh;
    Triangles adjacency;
    FaceTree<double> tree;
};

/// Do the points lie in the plane, and does each face carry its segment? Those of a straight closure carry nothing.
void check_is_contour(const Contour<double>& contour, const Mesh& mesh, const Vec3& normal, double offset,
                      bool is_closed = true) {
    REQUIRE(contour.points.size() >= 3);
    REQUIRE(contour.faces.size() == contour.points.size());
    const auto distance_to_face = [&](const Vec3& p, int f) {
        double least = std::numeric_limits<double>::infinity();
        for (int k = 0; k < 3; ++k)
            least = std::min(least, segment_distance(p, point(mesh.vertices, mesh.faces(f, k)),
                                                     point(mesh.vertices, mesh.faces(f, (k + 1) % 3))));
        return least;
    };
    double off_plane = 0, off_face = 0;
    for (std::size_t i = 0; i < contour.points.size(); ++i) {
        off_plane = std::max(off_plane, std::abs(normal.dot(contour.points[i]) - offset));
        if (i + 1 == contour.points.size() && !is_closed) break;
        const Vec3& next = contour.points[(i + 1) % contour.points.size()];
        off_face = std::max({off_face, distance_to_face(contour.points[i], contour.faces[i]),
                             distance_to_face(next, contour.faces[i])});
    }
    CHECK(off_plane < 1e-12);
    CHECK(off_face < 1e-12);
}

double length(const Contour<double>& contour) {
    double sum = 0;
    for (std::size_t i = 0; i < contour.points.size(); ++i)
        sum += (contour.points[(i + 1) % contour.points.size()] - contour.points[i]).norm();
    return sum;
}

/// The same points, in the same order around, from the first of them in the order of coordinates on.
std::vector<std::array<double, 3>> from_lowest(const Contour<double>& contour) {
    std::vector<std::array<double, 3>> out;
    for (const Vec3& p : contour.points) out.push_back({p[0], p[1], p[2]});
    std::rotate(out.begin(), std::min_element(out.begin(), out.end()), out.end());
    return out;
}

/// A contour of these points of the plane z = 0.
Contour<double> in_plane(const std::vector<std::array<double, 2>>& points) {
    Contour<double> out;
    for (const auto& [x, y] : points) {
        out.points.emplace_back(x, y, 0);
        out.faces.push_back(0);
    }
    return out;
}

} // namespace

TEST_CASE("a plane through a torus' axis cuts two circles, one across the axis two around each other") {
    const Surface ring(torus(1, 0.3, 64, 48));
    const auto across = ring.cut(Vec3::UnitY(), 0.01);
    REQUIRE(across.size() == 2);
    for (const Contour<double>& contour : across) {
        check_is_contour(contour, ring.mesh, Vec3::UnitY(), 0.01);
        CHECK(length(contour) == Approx(2 * pi * 0.3).epsilon(0.01));
    }
    CHECK(*std::min_element(across[0].faces.begin(), across[0].faces.end()) <
          *std::min_element(across[1].faces.begin(), across[1].faces.end()));

    const auto flat = ring.cut(Vec3::UnitZ(), 0.01);
    REQUIRE(flat.size() == 2);
    std::array<double, 2> lengths{length(flat[0]), length(flat[1])}, areas{};
    for (std::size_t i = 0; i < 2; ++i) {
        check_is_contour(flat[i], ring.mesh, Vec3::UnitZ(), 0.01);
        const PlanarRelation<double> relation = relate(flat[i], Vec3(0, 0, 0.01), Vec3(0, 0, 1));
        CHECK(relation.encloses);
        areas[i] = relation.area;
    }
    CHECK(areas[0] * areas[1] < 0); // solid to the same side
    std::sort(lengths.begin(), lengths.end());
    CHECK(lengths[0] == Approx(2 * pi * 0.7).epsilon(0.01));
    CHECK(lengths[1] == Approx(2 * pi * 1.3).epsilon(0.01));
}

TEST_CASE("a plane that passes a surface cuts nothing") {
    const Surface ball(sphere(1, 3));
    CHECK(ball.cut(Vec3::UnitX(), 1.01).empty());
    CHECK(ball.cut(Vec3::UnitX(), -1.01).empty());
    CHECK(ball.cut(Vec3::UnitX(), 0.99).size() == 1);
    CHECK_FALSE(ball.around(Vec3(1.2, 0, 0), Vec3::UnitX(), 10.0));
}

TEST_CASE("every face that a plane cuts carries one segment") {
    const Surface body(three_tubes());
    const Vec3 normal = Vec3(0.3, 0.2, 1).normalized();
    for (const double offset : {-0.5, 0.0, 0.3, 0.45}) {
        std::vector<int> faces;
        for (const Contour<double>& contour : body.cut(normal, offset)) {
            check_is_contour(contour, body.mesh, normal, offset);
            faces.insert(faces.end(), contour.faces.begin(), contour.faces.end());
        }
        std::sort(faces.begin(), faces.end());
        CHECK(faces == body.tree.faces_across(body.mesh, normal, offset));
        CHECK(faces.size() > 10);
    }
}

TEST_CASE("the contour around a point is the smallest that encloses it") {
    const Surface shells(side_by_side(side_by_side(sphere(3, 3), sphere(1, 3)), sphere(2, 3)));
    for (const double away : {0.5, 1.5, 2.5}) {
        const auto contour = shells.around(Vec3(0.1, away, 0.2), Vec3::UnitX(), 0.0);
        REQUIRE(contour);
        check_is_contour(*contour, shells.mesh, Vec3::UnitX(), 0.1);
        const double radius = std::ceil(away);
        CHECK(length(*contour) == Approx(2 * pi * std::sqrt(radius * radius - 0.01)).epsilon(0.01));
    }
    CHECK_FALSE(shells.around(Vec3(0.1, 3.5, 0.2), Vec3::UnitX(), 0.1));
}

TEST_CASE("what is hollow beside a point does not hide what encloses it") {
    // Small spheres on all sides within a large one: a look around meets one of those first, whichever way it goes.
    Mesh mesh = sphere(3, 3);
    for (int i = 0; i < 12; ++i) {
        const Vec3 place(0, 1.5 * std::cos(pi * i / 6), 1.5 * std::sin(pi * i / 6));
        mesh = side_by_side(mesh, moved(sphere(0.39, 2), {Eigen::Matrix3d::Identity(), 1, place}));
    }
    const Surface surface(mesh);
    CHECK(surface.cut(Vec3::UnitX(), 0.01).size() == 13);
    const auto contour = surface.around(Vec3(0.01, 0, 0), Vec3::UnitX(), 10.0);
    REQUIRE(contour);
    CHECK(length(*contour) == Approx(2 * pi * 3).epsilon(0.01));
}

TEST_CASE("where none encloses a point, the contour nearest to it is its own, within reach") {
    const Surface ring(torus(1, 0.3, 64, 48));
    const auto right = ring.around(Vec3(0.5, 0.01, 0), Vec3::UnitY(), 0.25);
    REQUIRE(right);
    CHECK(relate(*right, Vec3(1, 0.01, 0), Vec3(0, 1, 0)).encloses);
    const auto left = ring.around(Vec3(-0.1, 0.01, 0), Vec3::UnitY(), 2.0);
    REQUIRE(left);
    CHECK(relate(*left, Vec3(-1, 0.01, 0), Vec3(0, 1, 0)).encloses);
    CHECK_FALSE(ring.around(Vec3(0.5, 0.01, 0), Vec3::UnitY(), 0.15));
    const auto inside = ring.around(Vec3(1.1, 0.01, 0.1), Vec3::UnitY(), 0.0);
    REQUIRE(inside);
    CHECK(from_lowest(*inside) == from_lowest(*right));
}

TEST_CASE("the contour around a point is that one which a look at all of them finds") {
    // Tubes beside and in each other, one of them with a hole.
    Mesh mesh = torus(2, 0.7, 32, 12);
    mesh = side_by_side(mesh, torus(2, 0.3, 32, 12));
    mesh.faces.conservativeResize(mesh.faces.rows() - 25, 3);
    mesh = side_by_side(mesh, sphere(0.5, 2));
    const Surface surface(mesh);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> coordinate(-1, 1);
    const auto any = [&] { return Vec3(coordinate(random), coordinate(random), coordinate(random)); };
    int enclosing = 0, beside = 0;
    for (int i = 0; i < 400; ++i) {
        const Vec3 place = 2.8 * any(), normal = any().normalized();
        const double reach = 0.6;
        std::optional<Contour<double>> expected;
        double least = std::numeric_limits<double>::infinity();
        bool encloses = false;
        for (const Contour<double>& contour : surface.cut(normal, normal.dot(place))) {
            if (contour.points.size() < 3) continue;
            const PlanarRelation<double> relation = relate(contour, place, normal);
            const double size = relation.encloses ? std::abs(relation.area) : relation.distance;
            if (relation.encloses < encloses || (!relation.encloses && relation.distance > reach)) continue;
            if (relation.encloses == encloses && !(size < least)) continue;
            expected = contour;
            least = size;
            encloses = relation.encloses;
        }
        const auto found = surface.around(place, normal, reach);
        INFO(i);
        REQUIRE(found.has_value() == expected.has_value());
        if (!found) continue;
        ++(encloses ? enclosing : beside);
        CHECK(std::set<int>(found->faces.begin(), found->faces.end()) ==
              std::set<int>(expected->faces.begin(), expected->faces.end()));
    }
    CHECK(enclosing > 30);
    CHECK(beside > 50);
}

TEST_CASE("a contour broken by a hole is closed straight") {
    constexpr double radius = 0.5;
    constexpr int around = 32, along = 20;
    const Mesh whole = cylinder(radius, 2, around, along);
    // The quarter of the wall around (1, 1, z) / sqrt(2).
    std::vector<std::array<int, 3>> faces;
    for (Eigen::Index f = 0; f < whole.faces.rows(); ++f) {
        const Vec3 middle = face_area_vector(whole, f);
        const double angle = std::atan2(middle[1], middle[0]);
        const bool is_wall = std::abs(middle[2]) < 1e-9;
        if (!is_wall || angle < 0 || angle > pi / 2)
            faces.push_back({whole.faces(f, 0), whole.faces(f, 1), whole.faces(f, 2)});
    }
    std::vector<Vec3> vertices;
    for (Eigen::Index v = 0; v < whole.vertices.rows(); ++v) vertices.push_back(point(whole.vertices, v));
    const Surface open(make_mesh(vertices, faces));
    REQUIRE(open.mesh.faces.rows() == whole.faces.rows() - 2 * along * around / 4);

    const auto contours = open.cut(Vec3::UnitZ(), 1.03);
    REQUIRE(contours.size() == 1);
    check_is_contour(contours[0], open.mesh, Vec3::UnitZ(), 1.03, false);
    const double arc = 3 * around / 4 * 2 * radius * std::sin(pi / around), chord = radius * std::sqrt(2.0);
    CHECK(length(contours[0]) == Approx(arc + chord).epsilon(0.01));
    const Vec3 first = contours[0].points.front(), last = contours[0].points.back();
    CHECK((first - last).norm() == Approx(chord).epsilon(0.01));
    const double area = relate(contours[0], Vec3(0, 0, 1.03), Vec3(0, 0, 1)).area;
    CHECK(std::abs(area) == Approx((0.75 * pi + 0.5) * radius * radius).epsilon(0.01));

    // The closure counts as part of the contour.
    const Vec3 within(-0.1, -0.1, 1.03), beyond(0.3, 0.3, 1.03);
    const auto enclosing = open.around(within, Vec3::UnitZ(), 0.0);
    REQUIRE(enclosing);
    CHECK(from_lowest(*enclosing) == from_lowest(contours[0]));
    CHECK_FALSE(open.around(beyond, Vec3::UnitZ(), 0.1));
    CHECK(open.around(beyond, Vec3::UnitZ(), 1.0));
}

TEST_CASE("a linear field has its contours where planes cut") {
    const Vec3 normal = Vec3(0.2, -0.4, 0.7).normalized();
    for (const Mesh& mesh : {torus(1, 0.3), shuffled(three_tubes(), 3)}) {
        const Surface surface(mesh);
        Eigen::VectorXd field(mesh.vertices.rows());
        for (Eigen::Index v = 0; v < field.size(); ++v) field[v] = normal.dot(point(mesh.vertices, v));
        for (const double level : {-0.4, -0.1, 0.02, 0.3}) {
            const auto expected = surface.cut(normal, level);
            const auto found = LevelSets<double>(mesh, surface.adjacency, field).contours(level);
            REQUIRE(found.size() == expected.size());
            REQUIRE(!found.empty());
            for (std::size_t i = 0; i < found.size(); ++i) {
                CHECK(found[i].faces == expected[i].faces);
                CHECK(found[i].points == expected[i].points);
            }
        }
        CHECK(LevelSets<double>(mesh, surface.adjacency, field).contours(9.0).empty());
    }
}

TEST_CASE("the contours of a field need not lie in a plane") {
    const Mesh mesh = sphere(1, 4);
    const Surface surface(mesh);
    Eigen::VectorXd field(mesh.vertices.rows());
    for (Eigen::Index v = 0; v < field.size(); ++v) field[v] = std::abs(mesh.vertices(v, 2));
    const auto contours = LevelSets<double>(mesh, surface.adjacency, field).contours(0.6);
    REQUIRE(contours.size() == 2);
    for (const Contour<double>& contour : contours) CHECK(length(contour) == Approx(2 * pi * 0.8).epsilon(0.01));
    CHECK(contours[0].points[0][2] * contours[1].points[0][2] == Approx(-0.36).epsilon(0.01));
}

TEST_CASE("a contour's area is positive where it runs counter-clockwise around the normal") {
    const Contour<double> square = in_plane({{1, 1}, {3, 1}, {3, 4}, {1, 4}});
    const Vec3 up(0, 0, 1), place(2, 2, 0);
    CHECK(relate<double>(square, place, up).area == Approx(6));
    CHECK(relate<double>(square, place, -up).area == Approx(-6));
    CHECK(relate<double>(square, Vec3(-50, 7, 0), up).area == Approx(6));
    Contour<double> backwards = square;
    std::reverse(backwards.points.begin(), backwards.points.end());
    CHECK(relate<double>(backwards, place, up).area == Approx(-6));
    CHECK(relate<double>(backwards, place, up).encloses);
}

TEST_CASE("a concave contour encloses what lies in it, and not what lies in its bay") {
    const Contour<double> horseshoe = in_plane({{0, 0}, {5, 0}, {5, 4}, {4, 4}, {4, 1}, {1, 1}, {1, 4}, {0, 4}});
    const auto encloses = [&](double x, double y) {
        const bool above = relate<double>(horseshoe, Vec3(x, y, 0), Vec3(0, 0, 1)).encloses;
        CHECK(relate<double>(horseshoe, Vec3(x, y, 0), Vec3(0, 0, -1)).encloses == above);
        return above;
    };
    CHECK(encloses(0.5, 3));
    CHECK(encloses(4.5, 3));
    CHECK(encloses(2.5, 0.5));
    CHECK_FALSE(encloses(2.5, 2));
    CHECK_FALSE(encloses(2.5, 1.1));
    CHECK_FALSE(encloses(-0.1, 3));
    CHECK_FALSE(encloses(5.1, 0.5));
    CHECK_FALSE(encloses(2.5, 4.5));
    CHECK_FALSE(encloses(2.5, -0.1));
    // At the height of corners.
    CHECK_FALSE(encloses(-1, 4));
    CHECK_FALSE(encloses(7, 1));
    CHECK(encloses(0.5, 1));
}

TEST_CASE("a contour is as far from a point as the nearest of its points") {
    const Contour<double> square = in_plane({{1, 1}, {2, 1}, {3, 1}, {3, 4}, {1, 4}});
    const Vec3 up(0, 0, 1);
    CHECK(relate<double>(square, Vec3(2, 1.5, 0), up).distance == Approx(0.5));
    CHECK(relate<double>(square, Vec3(6, 8, 0), up).distance == Approx(5));
    CHECK(relate<double>(square, Vec3(3, 4, 0), up).distance == Approx(0).margin(1e-12));
}

TEST_CASE("a contour has the same points, in the same order, however the faces are numbered") {
    const Mesh mesh = three_tubes();
    std::vector<Vec3> vertices;
    for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) vertices.push_back(point(mesh.vertices, v));
    std::mt19937_64 random(9);
    const std::vector<int> order = random_permutation(static_cast<int>(mesh.faces.rows()), random);
    std::vector<std::array<int, 3>> faces;
    for (const int f : order) {
        const int k = f % 3;
        faces.push_back({mesh.faces(f, k), mesh.faces(f, (k + 1) % 3), mesh.faces(f, (k + 2) % 3)});
    }
    const Surface one(mesh), other(make_mesh(vertices, faces));
    const Vec3 normal = Vec3(0.1, 0.2, 1).normalized();
    std::set<std::vector<std::array<double, 3>>> expected, found;
    for (const Contour<double>& contour : one.cut(normal, 0.4)) expected.insert(from_lowest(contour));
    for (const Contour<double>& contour : other.cut(normal, 0.4)) found.insert(from_lowest(contour));
    CHECK(expected.size() == 2);
    CHECK(found == expected);
    const Vec3 place(0.42, 0.05, 0.4);
    const auto a = one.around(place, normal, 0.2), b = other.around(place, normal, 0.2);
    REQUIRE(a);
    REQUIRE(b);
    CHECK(from_lowest(*a) == from_lowest(*b));
}
