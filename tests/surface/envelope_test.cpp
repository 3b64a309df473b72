#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include <skelgen/core/error.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/surface/envelope.hpp>
#include <skelgen/surface/face_tree.hpp>
#include <skelgen/surface/impl/distance_band.hpp>
#include <skelgen/surface/impl/winding_tree.hpp>
#include <skelgen/surface/lattice_surface.hpp>
#include <skelgen/surface/manifold_parts.hpp>
#include <skelgen/surface/small_parts.hpp>
#include <skelgen/surface/winding_field.hpp>
#include <skelgen/surface/winding_tree.hpp>

#include "catch.hpp"
#include "mesh_changes.hpp"
#include "shapes.hpp"

using namespace skelgen;
using namespace skelgen::core;
using namespace skelgen::surface;
using namespace skelgen::test;

namespace {

/// Edge- and vertex-manifold without a border.
bool is_closed_manifold(const Mesh& mesh) {
    Eigen::Index vertices = 0;
    for (const auto& part : manifold_parts(mesh)) vertices += part.mesh.vertices.rows();
    return is_closed(mesh.faces) && vertices == mesh.vertices.rows();
}

/// Without the faces around the highest vertex, up to `depth` below it.
Mesh without_top(const Mesh& mesh, double depth) {
    const double top = mesh.vertices.col(2).maxCoeff();
    Mesh out = mesh;
    Eigen::Index row = 0;
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
        double lowest = top;
        for (int k = 0; k < 3; ++k) lowest = std::min(lowest, mesh.vertices(mesh.faces(f, k), 2));
        if (lowest < top - depth) out.faces.row(row++) = mesh.faces.row(f);
    }
    out.faces.conservativeResize(row, 3);
    return out;
}

EnvelopeOptions with_cells(double cells) {
    EnvelopeOptions options;
    options.cells = cells;
    return options;
}

} // namespace

TEMPLATE_TEST_CASE("the angle of a direction is the inverse tangent's", "", float, double) {
    constexpr auto pi = std::numbers::pi_v<TestType>;
    for (const TestType size : {TestType(1e-30), TestType(1), TestType(1e30)}) {
        for (int i = -1000; i <= 1000; ++i) {
            const TestType x = size * std::cos(pi * TestType(i) / 1000), y = size * std::sin(pi * TestType(i) / 1000);
            INFO(x << ", " << y);
            const TestType off = surface::detail::angle_of(x, y) - std::atan2(y, x);
            REQUIRE(std::abs(off) <= 4 * pi * std::numeric_limits<TestType>::epsilon());
        }
        CHECK(surface::detail::angle_of(-size, TestType(0)) == pi);
        CHECK(surface::detail::angle_of(-size, -TestType(0)) == -pi); // a place on a face, seen from its other side
        CHECK(surface::detail::angle_of(TestType(0), -size) == -pi / 2);
    }
}

TEMPLATE_TEST_CASE("the tree's winding number is that of the sum over all faces", "", float, double) {
    const Mesh exact = without_top(sphere(1, 4), 0.5);
    const TriangleMesh<TestType> mesh{exact.vertices.cast<TestType>(), exact.faces};
    const WindingTree<TestType> tree(mesh);
    std::mt19937 random(5);
    std::uniform_real_distribution<TestType> place(-2, 2);
    for (int i = 0; i < 200; ++i) {
        const Vector3<TestType> p(place(random), place(random), place(random));
        REQUIRE(std::abs(tree.winding_number(mesh, p) - winding_number(mesh, p)) < TestType(0.08));
    }
    CHECK(WindingTree<TestType>(TriangleMesh<TestType>{}).winding_number({}, Vector3<TestType>::Zero()) == 0);
}

TEST_CASE("solid angles add up over whole turns: around surfaces in each other, and turned inside out") {
    const Mesh ball = sphere(1, 2);
    const Mesh inside_out{ball.vertices, ball.faces.rowwise().reverse()};
    for (const int copies : {1, 2, 5})
        for (const Mesh& one : {ball, inside_out}) {
            Mesh mesh = one;
            for (int i = 1; i < copies; ++i) mesh = side_by_side(mesh, one);
            const WindingTree<double> tree(mesh);
            const double expected = (one.faces == ball.faces ? 1 : -1) * copies;
            CHECK(tree.winding_number(mesh, Vec3(0.1, 0.2, 0.3)) == Approx(expected).margin(0.08 * copies));
            CHECK(tree.winding_number(mesh, Vec3(3, 2, 1)) == Approx(0).margin(0.08 * copies));
        }
    // In the tree's only leaf, from near by, nothing is expanded: the sum is exact.
    const Mesh corner{(Points<double>(4, 3) << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1).finished(),
                      (Triangles(4, 3) << 0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3).finished()};
    const WindingTree<double> tree(corner);
    const Vec3 middle = corner.vertices.colwise().mean().transpose();
    CHECK(tree.winding_number(corner, middle) == Approx(1).epsilon(1e-12));
    CHECK(tree.winding_number(corner, middle + Vec3(9, 0, 0)) == Approx(0).margin(1e-4));
}

TEST_CASE("small parts cover the faces they are of, and have no long edges") {
    const Mesh mesh = box(Vec3(4, 1, 0.1));
    double area = 0, longest = 0;
    for_each_small_part(mesh, 0.3, [&](const Corners<double>& t) {
        area += (t[1] - t[0]).cross(t[2] - t[0]).norm() / 2;
        for (std::size_t k = 0; k < 3; ++k) longest = std::max(longest, (t[(k + 1) % 3] - t[k]).norm());
    });
    CHECK(area == Approx(surface_area(mesh)));
    CHECK(longest <= 0.3);
    int parts = 0;
    for_each_small_part(mesh, 5.0, [&](const Corners<double>&) { ++parts; });
    CHECK(parts == mesh.faces.rows());
}

TEST_CASE("an envelope has no more faces than wanted, about, and is as large as with more", "[slow]") {
    const Mesh ball = sphere(1, 3);
    EnvelopeOptions options = with_cells(150);
    const auto many = winding_envelope(ball, options);
    REQUIRE(many.faces.rows() > 20'000);
    options.most_faces = 4000;
    const auto few = winding_envelope(ball, options);
    CHECK(few.faces.rows() < 5000);
    CHECK(few.faces.rows() > 3000);
    CHECK(enclosed_volume(few) == Approx(enclosed_volume(many)).epsilon(0.03));
}

TEST_CASE("the band has the distances near the surface") {
    const Mesh mesh = box(Vec3(4, 1, 1)); // faces much larger than cells
    const FaceTree<double> tree(mesh);
    const Lattice<double> lattice = lattice_around(mesh, 0.1, 4);
    const SparseGrid<double> band = distance_band(mesh, lattice, 0.25);
    for (int z = 0; z < lattice.nodes[2]; ++z)
        for (int y = 0; y < lattice.nodes[1]; ++y)
            for (int x = 0; x < lattice.nodes[0]; x += 3) {
                const double expected = tree.distance(mesh, lattice.place({x, y, z})), found = band.get({x, y, z});
                if (expected < 0.2499) REQUIRE(std::abs(found - expected) < 1e-12);
                if (expected > 0.2501) REQUIRE(std::isinf(found));
            }
}

TEST_CASE("whatever nodes are inside, the surface around them is closed and manifold") {
    std::mt19937 random(7);
    Lattice<double> lattice;
    lattice.nodes = {24, 24, 24};
    std::vector<LatticeNode> all;
    SparseGrid<double> noise(lattice.nodes, 0);
    for (int z = 0; z < 24; ++z)
        for (int y = 0; y < 24; ++y)
            for (int x = 0; x < 24; ++x) {
                all.push_back({x, y, z});
                noise.at({x, y, z}) = std::ldexp(static_cast<double>(random()), -32) - 0.4;
            }
    LatticeShape<double> shape;
    shape.depth = [&](const LatticeNode& node) { return noise.get(node); };
    shape.crossing = [](const LatticeNode&, const LatticeNode&, double in, double out) { return in / (in - out); };
    const Mesh mesh = lattice_surface(lattice, all, shape);
    REQUIRE(mesh.faces.rows() > 1000);
    CHECK(is_closed_manifold(mesh));
    CHECK(enclosed_volume(mesh) > 0);
}

TEMPLATE_TEST_CASE("the envelope of a ball is the ball", "[slow]", float, double) {
    const Mesh exact = sphere(3, 4);
    const TriangleMesh<TestType> ball{exact.vertices.cast<TestType>(), exact.faces};
    const auto envelope = winding_envelope(ball, with_cells(60));
    CHECK(is_closed(envelope.faces));
    CHECK(euler_characteristic(envelope.faces) == 2);
    CHECK(enclosed_volume(envelope) == Approx(enclosed_volume(ball)).epsilon(0.01));
    CHECK(surface_area(envelope) == Approx(surface_area(ball)).epsilon(0.01));
}

TEST_CASE("overlapping boxes become one with the volume of their union", "[slow]") {
    const Mesh both = side_by_side(box(Vec3(2, 1, 1)), moved_by(box(Vec3(1, 1, 3)), Vec3(0.5, 0.25, -1.25)));
    const auto volume = [](double width, double depth, double height) { return width * depth * height; };
    const auto [low, high] = std::pair<Vec3, Vec3>{both.vertices.topRows(8).colwise().minCoeff().transpose(),
                                                   both.vertices.topRows(8).colwise().maxCoeff().transpose()};
    const Vec3 second_low = both.vertices.bottomRows(8).colwise().minCoeff().transpose(),
               second_high = both.vertices.bottomRows(8).colwise().maxCoeff().transpose();
    const Vec3 shared = high.cwiseMin(second_high) - low.cwiseMax(second_low);
    REQUIRE(shared.minCoeff() > 0.1);
    const double expected = volume(2, 1, 1) + volume(1, 1, 3) - volume(shared[0], shared[1], shared[2]);
    const Mesh envelope = winding_envelope(both, with_cells(100));
    CHECK(is_closed_manifold(envelope));
    CHECK(manifold_parts(envelope).size() == 1);
    CHECK(enclosed_volume(envelope) == Approx(expected).epsilon(0.02));
}

/// Without each third face: the rims of most holes meet.
Mesh torn(const Mesh& mesh) {
    Mesh out{mesh.vertices, Triangles(mesh.faces.rows() - (mesh.faces.rows() + 2) / 3, 3)};
    for (Eigen::Index f = 0, row = 0; f < mesh.faces.rows(); ++f)
        if (f % 3 != 0) out.faces.row(row++) = mesh.faces.row(f);
    return out;
}

TEST_CASE("winding numbers at a lattice's nodes are those of the sum over all faces") {
    const Mesh ball = sphere(1, 4);
    const Mesh open = without_top(ball, 0.6), inside_out = [&] {
        Mesh out = ball;
        out.faces.col(1).swap(out.faces.col(2));
        return out;
    }();
    const Mesh second = moved(ball, {random_rotation(3), 0.8, {0.7, 0.2, 0}});
    Mesh three_at_an_edge = side_by_side(open, second);
    three_at_an_edge.faces.conservativeResize(three_at_an_edge.faces.rows() + 1, 3);
    three_at_an_edge.faces.bottomRows(1) << open.faces(0, 0), open.faces(0, 1), open.faces(9, 2);
    for (const Mesh& mesh : {ball, open, side_by_side(open, second), side_by_side(ball, ball), inside_out,
                             without_faces(open, 40, 3), torn(ball), three_at_an_edge}) {
        const Lattice<double> lattice = lattice_around(mesh, 0.11, 3);
        const Mesh caps = surface::detail::caps_of(mesh);
        const WindingTree<double> tree(caps);
        const surface::detail::WindingField<double> field(mesh, caps, tree, lattice);
        int asked = 0;
        for (int x = 0; x < lattice.nodes[0]; x += 2)
            for (int y = 0; y < lattice.nodes[1]; ++y)
                for (int z = 0; z < lattice.nodes[2]; z += 2) {
                    const double exact = winding_number(mesh, lattice.place({x, y, z})) - 0.5;
                    ++asked;
                    REQUIRE(std::abs(field.depth({x, y, z}) - exact) < (caps.faces.rows() > 0 ? 0.05 : 1e-9));
                }
        CHECK(asked > 1000);
    }
}

TEST_CASE("what is axis-parallel, and passes through nodes of the lattice, is filled without streaks") {
    const Mesh mesh = box(Vec3(2, 1, 3), 4);
    Lattice<double> lattice = lattice_around(mesh, 0.25, 2);
    lattice.origin = mesh.vertices.colwise().minCoeff().transpose() - Vec3(0.625, 0.5, 0.5); // rows in its faces
    surface::detail::LatticeRows<double> rows(lattice);
    rows.add(mesh);
    for (int y = 0; y < lattice.nodes[1]; ++y)
        for (int z = 0; z < lattice.nodes[2]; ++z) {
            CHECK(rows.winding_number({lattice.nodes[0] - 1, y, z}) == 0);
            const bool is_within = y >= 2 && y < 6 && z >= 2 && z < 14;
            CHECK(rows.winding_number({4, y, z}) == (is_within ? 1 : 0));
        }
}

TEST_CASE("rims are the edges that faces do not pass both ways alike, and caps close them") {
    using surface::detail::rims_of;
    CHECK(rims_of(cube().faces).empty());
    CHECK(rims_of(without_faces(cube(), 10, 2).faces).size() == 4);
    Mesh turned = cube();
    turned.faces.row(0).reverseInPlace();
    const auto twice = rims_of(turned.faces);
    CHECK(twice.size() == 6); // each edge is passed twice the same way
    for (const Mesh& mesh : {without_faces(cube(), 10, 2), without_faces(cube(), 3, 5), turned}) {
        Mesh closed = surface::detail::caps_of(mesh);
        CHECK(closed.faces.rows() > 0);
        closed.faces.conservativeResize(closed.faces.rows() + mesh.faces.rows(), 3);
        closed.faces.bottomRows(mesh.faces.rows()) = mesh.faces;
        CHECK(rims_of(closed.faces).empty());
    }
}

TEST_CASE("caps are small but for few, whatever hangs together and however long a rim is") {
    const Mesh ball = sphere(1, 5);
    for (const Mesh& mesh : {torn(ball), without_top(ball, 0.1)}) {
        const Mesh caps = surface::detail::caps_of(mesh);
        REQUIRE(caps.faces.rows() > 40);
        Eigen::Index large = 0;
        for (Eigen::Index f = 0; f < caps.faces.rows(); ++f) {
            const auto corner = [&](int k) { return core::point(caps.vertices, caps.faces(f, k)); };
            large += (corner(0) - corner(2)).norm() > 0.3 ? 1 : 0; // ten edges
        }
        CHECK(4 * large < caps.faces.rows());
    }
}

TEST_CASE("an envelope closes holes", "[slow]") {
    const Mesh open = without_top(sphere(1, 4), 0.05);
    REQUIRE_FALSE(is_closed(open.faces));
    const Mesh envelope = winding_envelope(open, with_cells(80));
    CHECK(is_closed_manifold(envelope));
    CHECK(enclosed_volume(envelope) == Approx(4 * pi / 3).epsilon(0.03));
}

TEST_CASE("a narrow gap stays open to the winding number", "[slow]") {
    const double gap = 0.04; // three cells
    const Mesh both = side_by_side(cube(2), moved_by(cube(2), Vec3(1 + gap, 0, 0)));
    CHECK(manifold_parts(winding_envelope(both, with_cells(150))).size() == 2);
}

TEST_CASE("what encloses nothing has no envelope") {
    const Mesh sheet = make_mesh({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}});
    CHECK(winding_envelope(sheet, with_cells(50)).faces.rows() == 0);
}

TEST_CASE("options of envelopes have ranges") {
    REQUIRE_THROWS_AS(winding_envelope(cube(), with_cells(5)), Error);
    EnvelopeOptions no_faces;
    no_faces.most_faces = 0;
    REQUIRE_THROWS_AS(winding_envelope(cube(), no_faces), Error);
}
