#include <cmath>

#include <skelgen/core/adjacency.hpp>
#include <skelgen/refinement/head.hpp>

#include "catch.hpp"
#include "limb_shapes.hpp"
#include "shapes.hpp"

using namespace skelgen;
using namespace skelgen::refinement;
using namespace skelgen::core;
using namespace skelgen::test;

namespace {

/// A head of height 0.24 above a neck along z, its crown at z = 0.24: facing y, with a jaw and narrower at the front.
Mesh head_mesh() {
    const auto field = [](const Vec3& p) {
        const double narrowing = 1 - 1.5 * p.y(); // egg-shaped across
        const Vec3 skull(p.x() / (0.075 * narrowing), p.y() / 0.1, (p.z() - 0.15) / 0.09);
        const Vec3 jaw(p.x() / 0.045, (p.y() - 0.045) / 0.04, (p.z() - 0.06) / 0.05);
        const double neck =
            Vec3(p.x() / 0.05, (p.y() + 0.02) / 0.05, std::max(0.0, std::abs(p.z() + 0.05) - 0.1) / 0.02).norm();
        return std::min({skull.norm(), jaw.norm(), neck}) - 1;
    };
    return level_set(field, Vec3(-0.15, -0.15, -0.2), Vec3(0.15, 0.15, 0.27), 0.011);
}

std::optional<HeadShape<double>> shape_of(const Mesh& mesh, const Vec3& top, const Vec3& neck) {
    const Triangles adjacency = face_adjacency(mesh.faces);
    return measure_head(Slicer(mesh, adjacency), top, neck);
}

} // namespace

TEST_CASE("a head faces where its jaw is and where it is narrower, however it is turned and whatever its size") {
    const Mesh mesh = head_mesh();
    for (const double angle : {0.0, 0.7, 2.1, 4.0})
        for (const double scale : {1.0, 40.0}) {
            const Eigen::Matrix3d turn =
                (Eigen::AngleAxisd(angle, Vec3(0.3, -0.8, 0.5).normalized())).toRotationMatrix() * scale;
            Mesh turned = mesh;
            turned.vertices = mesh.vertices * turn.transpose();
            const auto head = shape_of(turned, turn * Vec3(0, 0, 0.24), turn * Vec3(0, -0.02, 0));
            REQUIRE(head.has_value());
            CHECK(head->forward.dot(turn * Vec3::UnitY() / scale) > 0.97);
            CHECK(head->up.dot(turn * Vec3::UnitZ() / scale) > 0.95);
            CHECK(head->frontness > 0.02);
            CHECK(head->length > head->breadth);
            CHECK(head->length / scale == Approx(0.2).epsilon(0.15));
            CHECK(head->breadth / scale == Approx(0.155).epsilon(0.15));
        }
}

TEST_CASE("a head is as many times an adult's as its neck has been taken to be too near") {
    const Mesh mesh = head_mesh();
    const auto as_adult = shape_of(mesh, Vec3(0, 0, 0.24), Vec3(0, -0.02, 0));
    const auto too_near = shape_of(mesh, Vec3(0, 0, 0.24), Vec3(0, -0.02, 0.08));
    REQUIRE(as_adult.has_value());
    REQUIRE(too_near.has_value());
    CHECK(as_adult->size == Approx(1).margin(0.2));
    CHECK(too_near->size / as_adult->size == Approx(1.5).epsilon(0.15));
}

TEST_CASE("the throat is where the neck is thinnest, above what it stands on") {
    const auto field = [](const Vec3& p) { // a head on a neck that is thinnest at z = -0.01 and widens to shoulders
        const Vec3 skull(p.x() / 0.075, p.y() / 0.1, (p.z() - 0.15) / 0.09);
        const double neck = 0.045 + 4 * (p.z() + 0.01) * (p.z() + 0.01);
        const double around = std::max(p.head<2>().norm() / neck, std::abs(p.z() + 0.04) / 0.12);
        return std::min(skull.norm(), around) - 1;
    };
    const Mesh mesh = level_set(field, Vec3(-0.2, -0.2, -0.18), Vec3(0.2, 0.2, 0.26), 0.01);
    const auto head = shape_of(mesh, Vec3(0, 0, 0.24), Vec3(0, 0, -0.03));
    REQUIRE(head.has_value());
    REQUIRE(head->throat.has_value());
    CHECK((*head->throat - Vec3(0, 0, -0.01)).norm() < 0.015);

    const auto bare = shape_of(head_mesh(), Vec3(0, 0, 0.24), Vec3(0, -0.02, 0)); // its neck ends without shoulders
    REQUIRE(bare.has_value());
    CHECK_FALSE(bare->throat.has_value());
}

TEST_CASE("a ball has no face, but a throat where it has a neck") {
    const auto field = [](const Vec3& p) { // a ball on a neck that widens to a trunk below z = -0.02
        const double neck = 0.04 + std::max(0.0, -p.z() - 0.02);
        const double around = std::max(p.head<2>().norm() / neck, std::abs(p.z() + 0.1) / 0.12);
        return std::min((p - Vec3(0, 0, 0.1)).norm() / 0.1, around) - 1;
    };
    const Mesh mesh = level_set(field, Vec3(-0.25, -0.25, -0.24), Vec3(0.25, 0.25, 0.22), 0.01);
    const auto head = shape_of(mesh, Vec3(0, 0, 0.2), Vec3(0, 0, -0.05));
    REQUIRE(head.has_value());
    CHECK(head->frontness == 0);
    CHECK(head->length == Approx(0.2).margin(0.01));
    CHECK(head->breadth == head->length);
    CHECK(head->joint == head->centroid);
    REQUIRE(head->throat.has_value());
    CHECK(head->throat->head<2>().norm() < 0.01);
    CHECK(std::abs(head->throat->z()) < 0.03);
}

TEST_CASE("where there is no head there is nothing to measure") {
    CHECK_FALSE(shape_of(sphere(0.1), Vec3(5, 0, 0), Vec3(5, 0, -1)).has_value());
}

TEST_CASE("in float a head has the same shape") {
    const Mesh mesh = head_mesh();
    const auto exact = shape_of(mesh, Vec3(0, 0, 0.24), Vec3(0, -0.02, 0));
    const TriangleMesh<float> rounded = mesh_in<float>(mesh);
    const Triangles adjacency = face_adjacency(rounded.faces);
    const auto found =
        measure_head(Slicer(rounded, adjacency), Vector3<float>(0, 0, 0.24F), Vector3<float>(0, -0.02F, 0));
    REQUIRE(exact.has_value());
    REQUIRE(found.has_value());
    CHECK((found->forward.cast<double>() - exact->forward).norm() < 1e-4);
    CHECK((found->joint.cast<double>() - exact->joint).norm() < 1e-4 * 0.24);
    CHECK(found->size == Approx(exact->size).epsilon(1e-4));
    CHECK(found->frontness == Approx(exact->frontness).margin(1e-4));
}

TEST_CASE("options of a head that would take for ever are refused") {
    CHECK_NOTHROW(validate(HeadOptions{}));
    HeadOptions options;
    options.slice = 0;
    CHECK_THROWS_AS(validate(options), Error);
}
