#include <cmath>
#include <type_traits>
#include <utility>

#include <skelgen/core/adjacency.hpp>
#include <skelgen/refinement/cross_section.hpp>

#include "catch.hpp"
#include "limb_shapes.hpp"
#include "mesh_changes.hpp"
#include "shapes.hpp"

using namespace skelgen;
using namespace skelgen::refinement;
using namespace skelgen::core;
using namespace skelgen::test;

namespace {

constexpr double radius = 0.5;
constexpr int around = 32;

double polygon_area(double r) { return around / 2.0 * r * r * std::sin(2 * pi / around); }
double polygon_perimeter(double r) { return 2 * around * r * std::sin(pi / around); }

std::optional<CrossSection<double>> cut(const Mesh& mesh, const Vec3& point, const Vec3& normal, double reach = 0) {
    const Triangles adjacency = face_adjacency(mesh.faces);
    return Slicer(mesh, adjacency).around(point, normal.normalized(), reach);
}

// It refers to mesh and adjacency: neither may be a temporary.
static_assert(std::is_constructible_v<Slicer<double>, const Mesh&, const Triangles&>);
static_assert(std::is_constructible_v<Slicer<double>, Mesh&, Triangles&>);
static_assert(!std::is_constructible_v<Slicer<double>, Mesh, const Triangles&>);
static_assert(!std::is_constructible_v<Slicer<double>, const Mesh, const Triangles&>);
static_assert(!std::is_constructible_v<Slicer<double>, const Mesh&, Triangles>);
static_assert(!std::is_constructible_v<Slicer<double>, const Mesh&, const Triangles>);
static_assert(!std::is_constructible_v<Slicer<double>, Mesh, Triangles>);
static_assert(!std::is_constructible_v<Slicer<float>, TriangleMesh<float>, const Triangles&>);

} // namespace

TEST_CASE("a cylinder cut across: centre, area, perimeter and thickness of a regular polygon") {
    const auto section = cut(cylinder(radius, 4, around), {0.1, 0.2, 1.03}, Vec3::UnitZ());
    REQUIRE(section);
    CHECK((section->centroid - Vec3(0, 0, 1.03)).norm() < 1e-12);
    CHECK(section->area == Approx(polygon_area(radius)));
    CHECK(section->perimeter == Approx(polygon_perimeter(radius)));
    CHECK(section->thickness == Approx(radius).epsilon(0.01));
    CHECK(section->lengths.sum() == Approx(section->perimeter));
    CHECK(section->normals.rows() == section->points.rows());
    CHECK(section->normals.col(2).cwiseAbs().maxCoeff() < 1e-12);
}

TEST_CASE("a plane through a ring of vertices cuts as any other, from either side") {
    for (const Vec3& normal : {Vec3(0, 0, 1), Vec3(0, 0, -1)}) {
        const auto section = cut(cylinder(radius, 4, around, 40), {0, 0, 2}, normal);
        REQUIRE(section);
        CHECK(section->area == Approx(polygon_area(radius)));
        CHECK(section->perimeter == Approx(polygon_perimeter(radius)));
        CHECK((section->centroid - Vec3(0, 0, 2)).norm() < 1e-12);
    }
}

TEST_CASE("a cylinder cut aslant is an ellipse") {
    const auto section = cut(cylinder(radius, 4, around), {0, 0, 2}, Vec3(1, 0, 1));
    REQUIRE(section);
    CHECK(section->area == Approx(polygon_area(radius) * std::sqrt(2)));
    CHECK((section->centroid - Vec3(0, 0, 2)).norm() < 1e-9);
}

TEST_CASE("a section moves, turns and grows with its surface") {
    const Motion motion{random_rotation(5), 30, Vec3(100, -50, 20)};
    const Mesh mesh = three_tubes();
    const Vec3 point = 0.6 * three_tube_ends()[1], normal = three_tube_ends()[1].normalized();
    const auto here = cut(mesh, point, normal);
    const auto there = cut(moved(mesh, motion), motion.apply(point), motion.rotation * normal);
    REQUIRE(here);
    REQUIRE(there);
    CHECK(there->area == Approx(900 * here->area));
    CHECK(there->thickness == Approx(30 * here->thickness));
    CHECK((motion.undo(there->centroid) - here->centroid).norm() < 1e-9);
}

TEST_CASE("of several contours the one around the point counts, the smallest if there are more") {
    const Mesh thin = capsule(0.2, 4, around), thick = capsule(0.5, 4, around);
    const Mesh mesh = side_by_side(thin, moved(thick, {Eigen::Matrix3d::Identity(), 1, Vec3(1, 0, 0)}));
    const auto left = cut(mesh, {0.1, 0, 2.01}, Vec3::UnitZ(), 10),
               right = cut(mesh, {0.6, 0, 2.01}, Vec3::UnitZ(), 10);
    REQUIRE(left);
    REQUIRE(right);
    CHECK(left->area == Approx(polygon_area(0.2)));
    CHECK(right->area == Approx(polygon_area(0.5)));

    const auto inner = cut(side_by_side(thick, thin), {0.1, 0, 2.01}, Vec3::UnitZ());
    REQUIRE(inner);
    CHECK(inner->area == Approx(polygon_area(0.2)));
}

TEST_CASE("without a contour around the point the nearest within reach counts") {
    const Mesh thin = capsule(0.2, 4, around), thick = capsule(0.5, 4, around);
    const Mesh mesh = side_by_side(thin, moved(thick, {Eigen::Matrix3d::Identity(), 1, Vec3(1.5, 0, 0)}));
    const Vec3 between(0.5, 0, 2.01); // 0.3 from the thin one, 0.5 from the thick one
    const auto nearest = cut(mesh, between, Vec3::UnitZ(), 1);
    REQUIRE(nearest);
    CHECK(nearest->area == Approx(polygon_area(0.2)));
    CHECK_FALSE(cut(mesh, between, Vec3::UnitZ(), 0.25));
    CHECK_FALSE(cut(mesh, {0, 0, 9}, Vec3::UnitZ(), 100));
}

TEST_CASE("a contour broken by a hole is closed straight") {
    const Mesh whole = cylinder(radius, 4, around, 4);
    Mesh open = whole; // without the two faces of one of the wall's quads: the chord across them is where they were
    Eigen::Index kept = 0, removed = 0;
    for (Eigen::Index f = 0; f < whole.faces.rows(); ++f) {
        Vec3 middle = Vec3::Zero();
        for (int k = 0; k < 3; ++k) middle += whole.vertices.row(whole.faces(f, k)).transpose() / 3;
        const double angle = std::atan2(middle.y(), middle.x());
        if (angle > 0 && angle < 2 * pi / around && middle.z() > 1 && middle.z() < 2)
            ++removed;
        else
            open.faces.row(kept++) = whole.faces.row(f);
    }
    REQUIRE(removed == 2);
    open.faces.conservativeResize(kept, 3);
    const auto section = cut(open, {0.1, 0, 1.53}, Vec3::UnitZ());
    REQUIRE(section);
    CHECK(section->area == Approx(polygon_area(radius)));
    CHECK(section->perimeter == Approx(polygon_perimeter(radius)));
}

TEST_CASE("the centre of a level set of the height is on the axis: of the longest one near by, else of the longest") {
    const Mesh thin = capsule(0.2, 4, around), thick = capsule(0.5, 4, around);
    const Mesh mesh = side_by_side(thin, moved(thick, {Eigen::Matrix3d::Identity(), 1, Vec3(3, 0, 0)}));
    const Triangles adjacency = face_adjacency(mesh.faces);
    const Slicer slicer(mesh, adjacency);
    const auto centre = [&](double level, const Vec3& near, double reach) {
        return level_set_centre<double>(slicer.level_sets(mesh.vertices.col(2)), level, near, reach);
    };
    for (const double reach : {5.0, 0.1}) { // both are near, or none is
        REQUIRE(centre(1.37, Vec3(1, 0, 1), reach));
        CHECK((*centre(1.37, Vec3(1, 0, 1), reach) - Vec3(3, 0, 1.37)).norm() < 1e-9);
    }
    REQUIRE(centre(1.37, Vec3(0.1, 0, 1.3), 0.1));
    CHECK((*centre(1.37, Vec3(0.1, 0, 1.3), 0.1) - Vec3(0, 0, 1.37)).norm() < 1e-9);
    CHECK_FALSE(centre(9, Vec3::Zero(), 1));
}

TEST_CASE("the Gauss map of a cylinder is flat, however it is cut") {
    CHECK(gauss_map_flatness(*cut(cylinder(radius, 4, around), {0, 0, 2.02}, Vec3::UnitZ())) < 1e-12);
    CHECK(gauss_map_flatness(*cut(cylinder(radius, 4, around), {0, 0, 2.02}, Vec3(0.5, 0, 1))) < 1e-12);
}

TEST_CASE("the Gauss map of a sphere's section at height h has flatness h^2, 1/3 at most") {
    const Mesh mesh = sphere(1, 5);
    for (const double h : {0.1, 0.25, 0.4, 0.55})
        CHECK(gauss_map_flatness(*cut(mesh, {0, 0, h}, Vec3::UnitZ())) == Approx(h * h).margin(0.01));
    CHECK(gauss_map_flatness(*cut(mesh, {0, 0, std::sqrt(1.0 / 3)}, Vec3::UnitZ())) == Approx(1.0 / 3).margin(0.01));
    CHECK(gauss_map_flatness(*cut(mesh, {0, 0, 0.9}, Vec3::UnitZ())) == Approx((1 - 0.81) / 2).margin(0.01));
}

TEST_CASE("the Gauss map of a cone has the squared sine of its half angle as flatness") {
    const double slope = std::tan(pi / 6);
    const Mesh cone = surface_of_revolution({{0, 0}, {slope, 0}, {slope / 2, 0.5}, {0, 1}}, 64);
    CHECK(gauss_map_flatness(*cut(cone, {0, 0, 0.3}, Vec3::UnitZ())) == Approx(0.25).epsilon(0.01));
}

TEST_CASE("in float a section has the same measures to seven digits' worth of its surface") {
    const Mesh mesh = three_tubes();
    const TriangleMesh<float> rounded = mesh_in<float>(mesh);
    const Triangles adjacency = face_adjacency(mesh.faces);
    const Vec3 point = 0.6 * three_tube_ends()[1], normal = three_tube_ends()[1].normalized();
    const auto exact = Slicer(mesh, adjacency).around(point, normal, 0);
    const auto found = Slicer(rounded, adjacency).around(point.cast<float>(), normal.cast<float>(), 0);
    REQUIRE(exact);
    REQUIRE(found);
    CHECK((found->centroid.cast<double>() - exact->centroid).norm() < 1e-6);
    CHECK(found->area == Approx(exact->area).epsilon(1e-5));
    CHECK(found->perimeter == Approx(exact->perimeter).epsilon(1e-5));
    CHECK(found->thickness == Approx(exact->thickness).epsilon(1e-5));
    CHECK(gauss_map_flatness(*found) == Approx(gauss_map_flatness(*exact)).margin(1e-5));
    CHECK(egg_shape(*found, Vector3<float>(Vector3<float>::UnitY())) ==
          Approx(egg_shape(*exact, Vec3(Vec3::UnitY()))).margin(1e-6));
}

TEMPLATE_TEST_CASE("a section that encloses nothing has its centre in the middle of its contour", "", float, double) {
    // Two sheets that lie on each other, between x = 1 and x = 3: cut across, there and back along a line.
    TriangleMesh<TestType> sheet;
    sheet.vertices.resize(4, 3);
    sheet.vertices << 1, 0, 0, 3, 0, 0, 3, 0, 1, 1, 0, 1;
    sheet.faces.resize(4, 3);
    sheet.faces << 0, 1, 2, 0, 2, 3, 3, 2, 1, 3, 1, 0;
    const Triangles adjacency = face_adjacency(sheet.faces);
    const auto section = Slicer<TestType>(sheet, adjacency)
                             .around(Vector3<TestType>(2, 0, TestType(0.5)), Vector3<TestType>::UnitZ(), 2);
    REQUIRE(section);
    CHECK(section->area == 0);
    CHECK(section->perimeter == Approx(4));
    CHECK((section->centroid - Vector3<TestType>(2, 0, TestType(0.5))).norm() < 1e-6);
    CHECK(section->thickness == Approx(0.5)); // half a length on either side of the middle, on average
}

TEST_CASE("a section is egg-shaped towards where it is narrower") {
    // A triangle with its tip at x = 2: centre of the area at x = 0, middle of the extent at x = 0.5.
    CrossSection<double> triangle;
    triangle.points.resize(3, 3);
    triangle.points << -1, -1, 0, 2, 0, 0, -1, 1, 0;
    triangle.centroid = Vec3::Zero();
    CHECK(egg_shape(triangle, Vec3(Vec3::UnitX())) == Approx(0.5));
    CHECK(egg_shape(triangle, Vec3(-Vec3::UnitX())) == Approx(-0.5));
    CHECK(egg_shape(triangle, Vec3(Vec3::UnitY())) == Approx(0).margin(1e-12));
}

TEST_CASE("a section is widest where its area reaches farthest, a round one nowhere") {
    Mesh mesh = cylinder(radius, 4, around);
    const auto widest = [&] {
        const auto section = cut(mesh, {0, 0, 1.03}, Vec3::UnitZ());
        REQUIRE(section);
        return widest_direction(*section);
    };
    CHECK(widest().norm() < 1e-9);
    mesh.vertices.col(0) *= 2;
    CHECK(widest().norm() == Approx(0.5));
    CHECK(std::abs(widest().x()) == Approx(0.5));
    for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) std::swap(mesh.vertices(v, 0), mesh.vertices(v, 1));
    mesh.faces.col(0).swap(mesh.faces.col(1));
    CHECK(std::abs(widest().y()) == Approx(0.5));
}
