#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <skelgen/core/geometry.hpp>
#include <skelgen/surface/face_tree.hpp>

#include "catch.hpp"
#include "mesh_changes.hpp"
#include "shapes.hpp"

using namespace skelgen;
using namespace skelgen::core;
using namespace skelgen::surface;
using namespace skelgen::test;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Numbers from -1 to 1, the same on every machine.
class Uniform {
public:
    explicit Uniform(unsigned seed) : random_(seed) {}

    double operator()() { return std::ldexp(static_cast<double>(random_() >> 11), -52) - 1; }
    Vec3 place() {
        const double x = (*this)(), y = (*this)(), z = (*this)();
        return {x, y, z};
    }

private:
    std::mt19937_64 random_;
};

Vec3 corner(const Mesh& mesh, Eigen::Index f, int k) { return point(mesh.vertices, mesh.faces(f, k)); }

std::vector<int> all_faces_across(const Mesh& mesh, const Vec3& normal, double offset) {
    std::vector<int> out;
    for (int f = 0; f < mesh.faces.rows(); ++f) {
        int above = 0;
        for (int k = 0; k < 3; ++k) above += normal.dot(corner(mesh, f, k)) >= offset;
        if (above == 1 || above == 2) out.push_back(f);
    }
    return out;
}

double distance_to_all(const Mesh& mesh, const Vec3& place) {
    double least = infinity;
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f)
        least = std::min(
            least, distance_to_triangle<double>(place, corner(mesh, f, 0), corner(mesh, f, 1), corner(mesh, f, 2)));
    return least;
}

/// From outside or inside of the box from the origin to `size`.
double distance_to_box(const Vec3& place, const Vec3& size) {
    const Vec3 out = (-place).cwiseMax(place - size);
    return out.maxCoeff() > 0 ? out.cwiseMax(0).norm() : -out.maxCoeff();
}

/// By trying points of the triangle; not less than the distance, and at most `step` of its longest side more.
double distance_by_samples(const Vec3& place, const std::array<Vec3, 3>& triangle, int steps) {
    double least = infinity;
    for (int i = 0; i <= steps; ++i)
        for (int j = 0; i + j <= steps; ++j) {
            const double u = static_cast<double>(i) / steps, v = static_cast<double>(j) / steps;
            const Vec3 p = triangle[0] + u * (triangle[1] - triangle[0]) + v * (triangle[2] - triangle[0]);
            least = std::min(least, (p - place).norm());
        }
    return least;
}

} // namespace

TEST_CASE("the faces across a plane are those that a look at every face finds") {
    Uniform uniform(1);
    for (const Mesh& mesh : {sphere(1, 3), capsule(0.2, 1.5), shuffled(torus(0.8, 0.2), 5)}) {
        const FaceTree<double> tree(mesh);
        std::size_t most = 0;
        for (int i = 0; i < 60; ++i) {
            const Vec3 normal = i < 6 ? Vec3(Vec3::Unit(i % 3)) : uniform.place().normalized();
            const double offset = i < 3 ? 0 : 1.2 * uniform();
            const std::vector<int> found = tree.faces_across(mesh, normal, offset);
            most = std::max(most, found.size());
            CHECK(found == all_faces_across(mesh, normal, offset));
        }
        CHECK(most > 20);
    }
}

TEST_CASE("near a place, the faces across a plane are those of all that come so near") {
    const Mesh mesh = torus(2, 0.7, 40, 16);
    const FaceTree<double> tree(mesh);
    Uniform random(8);
    for (int i = 0; i < 100; ++i) {
        const Vec3 normal = random.place().normalized(), place = 3 * random.place();
        const double offset = normal.dot(place), reach = 0.4;
        const std::vector<int> all = tree.faces_across(mesh, normal, offset);
        const std::vector<int> near = tree.faces_across(mesh, normal, offset, place, reach);
        CHECK(std::includes(all.begin(), all.end(), near.begin(), near.end()));
        for (const int f : all)
            if (distance_to_triangle<double>(place, corner(mesh, f, 0), corner(mesh, f, 1), corner(mesh, f, 2)) < reach)
                REQUIRE(std::binary_search(near.begin(), near.end(), f));
    }
    CHECK(tree.faces_across(mesh, Vec3::UnitZ(), 0, Vec3(9, 0, 0), 1).empty());
}

TEST_CASE("the nearest vertex is that of all, and no distance is larger than asked for") {
    const Mesh mesh = torus(2, 0.7, 40, 16);
    const FaceTree<double> tree(mesh);
    Uniform random(11);
    for (int i = 0; i < 100; ++i) {
        const Vec3 place = 3 * random.place();
        CHECK(tree.nearest_vertex(mesh, place) == nearest_vertex(mesh, place));
        double nearest = infinity;
        for (int f = 0; f < static_cast<int>(mesh.faces.rows()); ++f)
            nearest = std::min(nearest, distance_to_triangle<double>(place, corner(mesh, f, 0), corner(mesh, f, 1),
                                                                     corner(mesh, f, 2)));
        CHECK(tree.distance(mesh, place) == nearest);
        CHECK(tree.distance(mesh, place, 0.5) == std::min(nearest, 0.5));
    }
    CHECK(tree.nearest_vertex(mesh, Vec3::Zero()) ==
          nearest_vertex<double>(mesh, Vec3::Zero())); // many are equally near
}

TEST_CASE("the nearest corner is one of the nearest face, though another vertex may be nearer") {
    Mesh mesh;
    mesh.vertices.resize(6, 3);
    mesh.vertices << -3, -3, 0, 3, -3, 0, 0, 5, 0, 0, 0, 0.1, 1, 0, 1, 0, 1, 1;
    mesh.faces.resize(2, 3);
    mesh.faces << 0, 1, 2, 3, 4, 5;
    const FaceTree<double> tree(mesh);
    CHECK(tree.nearest_vertex(mesh, Vec3(0.1, 0, 0.01)) == 3);
    CHECK(tree.nearest_corner(mesh, Vec3(0.1, 0, 0.01)) == 1);
    CHECK(tree.nearest_corner(mesh, Vec3(0.1, 0, 0.09)) == 3);
    for (const double none : {infinity, std::numeric_limits<double>::quiet_NaN()})
        CHECK(tree.nearest_corner(mesh, Vec3(0, 0, none)) >= 0);

    const Mesh round = torus(2, 0.7, 40, 16);
    const FaceTree<double> of_round(round);
    for (int f = 0; f < static_cast<int>(round.faces.rows()); ++f) {
        const Vec3 place = 0.98 * corner(round, f, 0) + 0.01 * (corner(round, f, 1) + corner(round, f, 2));
        CHECK(of_round.nearest_corner(round, place) == round.faces(f, 0));
    }
}

TEST_CASE("a ray meets all faces in its way, the first one among them") {
    const Mesh mesh = torus(2, 0.7, 40, 16);
    const FaceTree<double> tree(mesh);
    Uniform random(9);
    for (int i = 0; i < 100; ++i) {
        const Vec3 place = 3 * random.place(), direction = random.place().normalized();
        const std::vector<int> met = tree.faces_along(mesh, place, direction);
        const int first = tree.first_along(mesh, place, direction).face;
        REQUIRE((first < 0) == met.empty());
        if (first >= 0) CHECK(std::binary_search(met.begin(), met.end(), first));
        CHECK(met.size() <= 4);
        CHECK(met.size() % 2 == (winding_number(mesh, place) > 0.5 ? 1 : 0)); // in and out again
    }
}

TEST_CASE("a ray tells how often a surface winds around a place, as the winding number does") {
    const Mesh ring = torus(2, 0.7, 40, 16);
    Mesh twice = ring; // winding around itself where the two overlap
    twice.vertices.conservativeResize(2 * ring.vertices.rows(), 3);
    twice.vertices.bottomRows(ring.vertices.rows()) = ring.vertices.rowwise() + Eigen::RowVector3d(0.3, 0.2, 0.1);
    twice.faces.conservativeResize(2 * ring.faces.rows(), 3);
    twice.faces.bottomRows(ring.faces.rows()) = ring.faces.array() + static_cast<int>(ring.vertices.rows());
    Mesh inside_out = ring;
    inside_out.faces.col(0).swap(inside_out.faces.col(1));
    Uniform random(3);
    for (const Mesh& mesh : {ring, twice, inside_out}) {
        const FaceTree<double> tree(mesh);
        int certain = 0;
        for (int i = 0; i < 100; ++i) {
            const Vec3 place = 3 * random.place(), direction = random.place().normalized();
            const auto windings = tree.windings_along(mesh, place, direction);
            if (!windings) continue;
            ++certain;
            CHECK(*windings == Approx(winding_number(mesh, place)).margin(1e-6));
        }
        CHECK(certain > 95);
    }
}

TEST_CASE("a ray through an edge or a corner does not tell how often a surface winds around a place") {
    const Mesh mesh = cube();
    const FaceTree<double> tree(mesh);
    const Vec3 middle = Vec3::Constant(0.5);
    CHECK(winding_number(mesh, middle) == Approx(1));
    CHECK_FALSE(tree.windings_along(mesh, middle, Vec3::Constant(1).normalized()));
    CHECK_FALSE(tree.windings_along(mesh, middle, Vec3(1, 1, 0).normalized()));
    CHECK(tree.windings_along(mesh, middle, Vec3(3, 2, 1).normalized()) == 1);
}

TEST_CASE("a plane through vertices has them above it") {
    const Mesh mesh = cube();
    const FaceTree<double> tree(mesh);
    CHECK(tree.faces_across(mesh, Vec3::UnitZ(), 0.0).empty());
    CHECK(tree.faces_across(mesh, Vec3::UnitZ(), 1.0) == all_faces_across(mesh, Vec3::UnitZ(), 1.0));
    CHECK(tree.faces_across(mesh, Vec3::UnitZ(), 1.0).size() == 8);
    CHECK(tree.faces_across(mesh, Vec3::UnitZ(), 0.5).size() == 8);
    CHECK(tree.faces_across(mesh, Vec3::UnitZ(), 1.5).empty());
}

TEST_CASE("the distance to a surface is the least of those to its triangles") {
    Uniform uniform(2);
    for (const Mesh& mesh : {capsule(0.2, 1), shuffled(sphere(0.7, 2), 3)}) {
        const FaceTree<double> tree(mesh);
        for (int i = 0; i < 40; ++i) {
            const Vec3 place = 1.5 * uniform.place();
            CHECK(tree.distance(mesh, place) == distance_to_all(mesh, place));
        }
    }
}

TEST_CASE("the distance to a sphere and to a box is that of the closed form") {
    const Mesh ball = sphere(2, 4);
    const FaceTree<double> tree(ball);
    CHECK(tree.distance(ball, Vec3::Zero()) == Approx(2).epsilon(0.005));
    CHECK(tree.distance(ball, Vec3(0, 0, 5)) == Approx(3));
    CHECK(tree.distance(ball, Vec3(0.3, -0.4, 1.2)) == Approx(0.7).margin(0.01));
    CHECK(tree.distance(ball, Vec3(0, 2, 0)) == 0);

    const Vec3 size(1, 2, 3);
    const Mesh block = box(size, 2);
    const FaceTree<double> sides(block);
    Uniform uniform(3);
    for (int i = 0; i < 100; ++i) {
        const Vec3 place = size / 2 + 2.5 * uniform.place();
        CHECK(sides.distance(block, place) == Approx(distance_to_box(place, size)).epsilon(1e-12).margin(1e-12));
    }
}

TEST_CASE("a point above, beside and at the corners of a triangle is as far from it as it is") {
    const Vec3 a(0, 0, 0), b(4, 0, 0), c(0, 3, 0);
    const auto distance = [&](const Vec3& p) { return distance_to_triangle<double>(p, a, b, c); };
    CHECK(distance({1, 1, 0}) == 0);
    CHECK(distance({1, 1, 2}) == Approx(2));
    CHECK(distance({1, 1, -2}) == Approx(2));
    CHECK(distance({2, -1.5, 2}) == Approx(2.5));      // beside ab
    CHECK(distance({-3, 1, 4}) == Approx(5));          // beside ca
    CHECK(distance({2 + 3, 1.5 + 4, 0}) == Approx(5)); // beside bc, whose normal is (3, 4) / 5
    CHECK(distance({-3, -4, 12}) == Approx(13));       // a
    CHECK(distance({7, -1, 0}) == Approx(std::sqrt(10.0)));
    CHECK(distance({-1, 5, 0}) == Approx(std::sqrt(5.0)));
    CHECK(distance(a) == 0);
    CHECK(distance({2, 0, 0}) == 0);
}

TEST_CASE("the distance to any triangle is that to the nearest of its points, whichever way round it is") {
    Uniform uniform(4);
    for (int i = 0; i < 60; ++i) {
        const std::array<Vec3, 3> t{uniform.place(), uniform.place(), uniform.place()};
        const Vec3 place = 2 * uniform.place();
        constexpr int steps = 60;
        const double found = distance_to_triangle<double>(place, t[0], t[1], t[2]);
        const double expected = distance_by_samples(place, t, steps);
        CHECK(found <= expected + 1e-12);
        CHECK(found >= expected - 4.0 / steps);
        CHECK(distance_to_triangle<double>(place, t[0], t[2], t[1]) == Approx(found).margin(1e-12));
        CHECK(distance_to_triangle<double>(place, t[1], t[2], t[0]) == Approx(found).margin(1e-12));
    }
}

TEST_CASE("a degenerate triangle is as near as the segment or the point that it is") {
    const Vec3 a(0, 0, 0), b(2, 0, 0), middle(1, 0, 0);
    CHECK(distance_to_triangle<double>({1, 3, 0}, a, b, middle) == Approx(3));
    CHECK(distance_to_triangle<double>({5, 4, 0}, a, middle, b) == Approx(5));
    CHECK(distance_to_triangle<double>({1, 0, 2}, a, b, b) == Approx(2));
    CHECK(distance_to_triangle<double>({-3, 0, 4}, a, a, b) == Approx(5));
    CHECK(distance_to_triangle<double>({0, 3, 4}, a, a, a) == Approx(5));
    CHECK(distance_to_triangle<double>(a, a, a, a) == 0);
}

TEST_CASE("a triangle without area but for rounding is as near as the segment that it is") {
    Uniform uniform(5);
    double worst = 0;
    for (int i = 0; i < 2000; ++i) {
        const Vec3 a = uniform.place(), b = uniform.place(), place = 2 * uniform.place();
        const Vec3 c = a + (0.5 + 0.5 * uniform()) * (b - a);
        worst = std::max(worst, std::abs(distance_to_triangle<double>(place, a, b, c) - segment_distance(place, a, b)));
    }
    CHECK(worst < 1e-9);
}

TEST_CASE("a ray meets a sphere where the closed form says, seen from inside and outside") {
    constexpr double radius = 2;
    const Mesh mesh = sphere(radius, 5);
    const FaceTree<double> tree(mesh);
    Uniform uniform(6);
    for (int i = 0; i < 60; ++i) {
        const Vec3 place = uniform.place(), direction = uniform.place().normalized();
        const double along = place.dot(direction);
        const double expected = -along + std::sqrt(along * along + radius * radius - place.squaredNorm());
        const auto hit = tree.first_along(mesh, place, direction);
        CHECK(hit.distance == Approx(expected).margin(0.01));
        REQUIRE(hit.face >= 0);
        CHECK(distance_to_triangle<double>(place + hit.distance * direction, corner(mesh, hit.face, 0),
                                           corner(mesh, hit.face, 1), corner(mesh, hit.face, 2)) < 1e-12);
        // From far away along the same line: the nearer of both places.
        const Vec3 outside = place - 10 * direction;
        const double first = 10 - along - std::sqrt(along * along + radius * radius - place.squaredNorm());
        CHECK(tree.first_along(mesh, outside, direction).distance == Approx(first).margin(0.01));
        CHECK(tree.first_along(mesh, outside, -direction).face == -1);
    }
}

TEST_CASE("a ray that passes a surface meets nothing, and one along an axis is no exception") {
    const Mesh ball = sphere(1, 4);
    const FaceTree<double> tree(ball);
    for (int k = 0; k < 3; ++k)
        for (const double sign : {-1.0, 1.0}) {
            const Vec3 direction = sign * Vec3::Unit(k), beside = 1.01 * Vec3::Unit((k + 1) % 3);
            CHECK(tree.first_along(ball, beside - 3 * direction, direction).face == -1);
            CHECK(tree.first_along(ball, beside - 3 * direction, direction).distance == infinity);
            CHECK(tree.first_along(ball, 0.5 * beside - 3 * direction, direction).distance ==
                  Approx(3 - std::sqrt(1 - 0.505 * 0.505)).margin(0.01));
            // Through a vertex, where four faces meet.
            CHECK(tree.first_along(ball, Vec3::Zero(), direction).distance == Approx(1));
            CHECK(tree.first_along(ball, -4 * direction, direction).distance == Approx(3));
            CHECK(tree.first_along(ball, 4 * direction, direction).face == -1);
        }
}

namespace {

/// How many of these targets on a surface a ray from `centre` does not meet it at.
int missed(const Mesh& mesh, const Vec3& centre, const std::vector<Vec3>& targets) {
    const FaceTree<double> tree(mesh);
    int count = 0;
    for (const Vec3& target : targets) {
        const double away = (target - centre).norm();
        const double found = tree.first_along(mesh, centre, (target - centre) / away).distance;
        count += !(std::abs(found - away) < 1e-12 * away);
    }
    return count;
}

Mesh turned_sphere(unsigned seed) { return moved(sphere(1, 2), {random_rotation(seed), 1.3, Vec3(0.1, -0.2, 0.3)}); }

} // namespace

TEST_CASE("a ray does not slip through an edge") {
    for (unsigned seed = 0; seed < 20; ++seed) {
        const Mesh mesh = turned_sphere(seed);
        std::vector<Vec3> middles;
        for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f)
            for (int k = 0; k < 3; ++k) middles.emplace_back((corner(mesh, f, k) + corner(mesh, f, (k + 1) % 3)) / 2);
        CHECK(missed(mesh, Vec3(0.1, -0.2, 0.3), middles) == 0);
    }
}

TEST_CASE("a ray does not slip through a vertex") {
    for (unsigned seed = 0; seed < 20; ++seed) {
        const Mesh mesh = turned_sphere(seed);
        std::vector<Vec3> vertices;
        for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) vertices.push_back(point(mesh.vertices, v));
        CHECK(missed(mesh, Vec3(0.1, -0.2, 0.3), vertices) == 0);
    }
}

TEST_CASE("a mesh without faces is met and cut nowhere, and one of a single face is") {
    const Mesh none = make_mesh({}, {}), one = make_mesh({{0, 0, 1}, {1, 0, 1}, {0, 1, 2}}, {{0, 1, 2}});
    for (const FaceTree<double>& tree : {FaceTree<double>(none), FaceTree<double>()}) {
        CHECK(tree.faces_across(none, Vec3::UnitX(), 0.0).empty());
        CHECK(tree.distance(none, Vec3::Zero()) == infinity);
        CHECK(tree.nearest_vertex(none, Vec3::Zero()) == -1);
        CHECK(tree.nearest_corner(none, Vec3::Zero()) == -1);
        CHECK(tree.first_along(none, Vec3::Zero(), Vec3::UnitX()).face == -1);
    }
    const FaceTree<double> tree(one);
    CHECK(tree.faces_across(one, Vec3::UnitZ(), 1.5) == std::vector<int>{0});
    CHECK(tree.distance(one, Vec3::Zero()) == 1);
    CHECK(tree.first_along(one, Vec3(0.25, 0.25, 0), Vec3::UnitZ()).distance == Approx(1.25));
    CHECK(tree.first_along(one, Vec3(0.75, 0.75, 0), Vec3::UnitZ()).face == -1);
}

TEST_CASE("in float the tree answers as in double") {
    const Mesh mesh = capsule(0.2, 1);
    const TriangleMesh<float> rounded{mesh.vertices.cast<float>(), mesh.faces};
    const FaceTree<float> tree(rounded);
    const Vector3<float> place(0.05f, 0, 0.5f);
    CHECK(tree.distance(rounded, place) == Approx(FaceTree<double>(mesh).distance(mesh, place.cast<double>())));
    CHECK(tree.first_along(rounded, place, Vector3<float>::UnitX()).distance == Approx(0.15f).epsilon(0.01));
    CHECK(tree.faces_across(rounded, Vector3<float>::UnitZ(), 0.51f).size() == 64);
}
