#include "catch.hpp"

#include <Eigen/Geometry>

#include <skelgen/core/error.hpp>
#include <skelgen/render/view.hpp>

#include "scenes.hpp"

using namespace skelgen;
using namespace skelgen::render;
using namespace skelgen::test;
using Vector = Vector3<double>;

TEST_CASE("views are read from their names or three numbers") {
    CHECK(std::get<NamedView>(parse_view("front")) == NamedView::front);
    CHECK(std::get<NamedView>(parse_view("three-quarter")) == NamedView::three_quarter);
    CHECK(std::get<Vector>(parse_view("1,-2.5,1e2")) == Vector(1, -2.5, 100));
    for (const char* bad : {"", "above", "1,2", "1,2,3,4", "1,2,x", "1 2 3", "0,0,0", "nan,0,1", "1,2,3 "}) {
        INFO(bad);
        CHECK_THROWS_AS(parse_view(bad), Error);
    }
}

TEST_CASE("every camera is orthonormal and right-handed, and its up is the body's") {
    Scene scene;
    scene.skeleton = small_skeleton();
    for (const char* name :
         {"front", "back", "side", "top", "three-quarter", "1,2,3", "0,1,0", "0,-1,0", "0,1,0.0001"}) {
        INFO(name);
        const Camera camera = look_at(scene, parse_view(name));
        Eigen::Matrix3d axes;
        axes << camera.right, camera.up, camera.toward;
        CHECK((axes.transpose() * axes - Eigen::Matrix3d::Identity()).norm() < 1e-12);
        CHECK(axes.determinant() == Approx(1));
        CHECK(camera.up.dot(scene.skeleton->frame.up) > -1e-12);
    }
}

TEST_CASE("named views look from where they say") {
    Scene scene;
    scene.skeleton = small_skeleton();
    const auto& frame = scene.skeleton->frame;
    CHECK(look_at(scene, NamedView::front).toward.isApprox(frame.forward));
    CHECK(look_at(scene, NamedView::front).right.isApprox(frame.left));
    CHECK(look_at(scene, NamedView::back).toward.isApprox(-frame.forward));
    CHECK(look_at(scene, NamedView::side).toward.isApprox(frame.left));
    CHECK(look_at(scene, NamedView::top).toward.isApprox(frame.up));
    CHECK(look_at(scene, NamedView::top).up.isApprox(-frame.forward));
}

TEST_CASE("without a skeleton the longest axis of the mesh is up") {
    Scene scene;
    scene.mesh = sphere(20);
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vector(1, 2, 3).normalized()).toRotationMatrix();
    scene.mesh.vertices = scene.mesh.vertices * Vector(2, 5, 1).asDiagonal() * turn.transpose();
    const Camera camera = look_at(scene, NamedView::front);
    CHECK(std::abs(camera.up.dot(turn.col(1))) == Approx(1).epsilon(1e-3));
    CHECK(std::abs(camera.toward.dot(turn.col(2))) == Approx(1).epsilon(1e-3));
}

TEST_CASE("a frame that is none falls back on the mesh") {
    Scene scene;
    scene.skeleton = small_skeleton();
    scene.skeleton->frame.forward = scene.skeleton->frame.up;
    scene.mesh = sphere(10);
    scene.mesh.vertices.col(0) *= 3;
    scene.mesh.vertices.col(1) *= 2;
    CHECK(look_at(scene, NamedView::front).up.isApprox(Vector::UnitX(), 1e-6));
}
