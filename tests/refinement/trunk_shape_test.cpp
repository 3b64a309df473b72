#include <cmath>

#include <skelgen/core/adjacency.hpp>
#include <skelgen/refinement/trunk_shape.hpp>

#include "catch.hpp"
#include "limb_shapes.hpp"
#include "shapes.hpp"

using namespace skelgen;
using namespace skelgen::refinement;
using namespace skelgen::core;
using namespace skelgen::test;

namespace {

/// A trunk along z from 0 to 1 whose sections are an ellipse with a rounder half towards y by `belly`.
Mesh trunk_mesh(double belly) {
    const auto field = [belly](const Vec3& p) {
        const double depth = p.y() > 0 ? 0.15 + belly : 0.15;
        const double beyond = std::max(0.0, std::abs(p.z() - 0.5) - 0.5);
        return Vec3(p.x() / 0.2, p.y() / depth, beyond / 0.1).norm() - 1;
    };
    return level_set(field, Vec3(-0.35, -0.35, -0.25), Vec3(0.35, 0.4, 1.25), 0.026);
}

} // namespace

TEST_CASE("a trunk faces to where it is rounder, however it is turned") {
    const Mesh mesh = trunk_mesh(0.06);
    for (const double angle : {0.0, 1.3, 3.0}) {
        const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle, Vec3(1, 2, -1).normalized()).toRotationMatrix();
        Mesh turned = mesh;
        turned.vertices = mesh.vertices * turn.transpose();
        const Triangles adjacency = face_adjacency(turned.faces);
        const Slicer slicer(turned, adjacency);
        for (const double sense : {-1.0, 1.0}) {
            const auto trunk = measure_trunk(slicer, Vec3(Vec3::Zero()), Vec3(turn * Vec3::UnitZ()),
                                             Vec3(turn * Vec3(sense * 0.1, 0, 0.02)));
            REQUIRE(trunk.has_value());
            CHECK(trunk->forward.dot(turn * Vec3::UnitY()) > 0.99);
            CHECK(trunk->frontness > 0.002);
        }
    }
}

TEST_CASE("a trunk that is as round behind as before says nothing") {
    const Mesh mesh = trunk_mesh(0);
    const Triangles adjacency = face_adjacency(mesh.faces);
    const auto trunk = measure_trunk(Slicer(mesh, adjacency), Vec3(0, 0, 0), Vec3(0, 0, 1), Vec3(1, 0, 0));
    REQUIRE(trunk.has_value());
    CHECK(trunk->frontness < 1e-3);
}

TEST_CASE("without a trunk around it, or with hips along the spine, there is no front") {
    const Mesh mesh = trunk_mesh(0.06);
    const Triangles adjacency = face_adjacency(mesh.faces);
    const Slicer slicer(mesh, adjacency);
    CHECK_FALSE(measure_trunk(slicer, Vec3(9, 0, 0), Vec3(9, 0, 1), Vec3(1, 0, 0)).has_value());
    CHECK_FALSE(measure_trunk(slicer, Vec3(0, 0, 0), Vec3(0, 0, 1), Vec3(0, 0, 1)).has_value());
    const Vec3 up = Vec3(1, 2, 3).normalized(); // along the spine but for rounding
    CHECK_FALSE(measure_trunk(slicer, Vec3(0, 0, 0), up, Vec3((1 / 3.0) * up)).has_value());
    CHECK_FALSE(measure_trunk(slicer, Vec3(0, 0, 0), Vec3(0, 0, 0), Vec3(1, 0, 0)).has_value());
}

TEST_CASE("in float a trunk has the same front") {
    const Mesh mesh = trunk_mesh(0.06);
    const TriangleMesh<float> rounded = mesh_in<float>(mesh);
    const Triangles adjacency = face_adjacency(mesh.faces);
    const Vector3<float> hips(0, 0, 0), neck(0, 0, 1), across(0.1F, 0, 0.02F);
    const auto exact = measure_trunk(Slicer(mesh, adjacency), Vec3(0, 0, 0), Vec3(0, 0, 1), Vec3(0.1, 0, 0.02));
    const auto found = measure_trunk(Slicer(rounded, adjacency), hips, neck, across);
    REQUIRE(exact.has_value());
    REQUIRE(found.has_value());
    CHECK((found->forward.cast<double>() - exact->forward).norm() < 1e-5);
    CHECK(found->frontness == Approx(exact->frontness).margin(1e-5));
    CHECK_FALSE(measure_trunk(Slicer(rounded, adjacency), hips, neck, Vector3<float>(1e-8F, 0, 1)).has_value());
}
