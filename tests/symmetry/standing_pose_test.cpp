#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include <skelgen/symmetry/impl/standing_pose.hpp>

#include "catch.hpp"

using namespace skelgen;
using namespace skelgen::symmetry;

namespace {

using Vec3 = Vector3<double>;

const Vec3 right = Vec3::UnitX(), forward = Vec3::UnitY(), up = Vec3::UnitZ();

Eigen::AngleAxisd turn(double degrees, const Vec3& axis) {
    return Eigen::AngleAxisd(degrees * std::numbers::pi / 180, axis);
}

/// A leg from standing straight: the knee folded back, then the whole leg swung forwards.
LegBones<double> leg(double knee, double hip) {
    const Eigen::Matrix3d swing = turn(hip, right).toRotationMatrix();
    const Eigen::Matrix3d fold = turn(-knee, right).toRotationMatrix();
    return {swing * Vec3(-up), swing * fold * Vec3(-up), swing * fold * forward};
}

double degrees_from_forward(const LegBones<double>& bones) {
    const Vec3 standing = standing_foot_direction(bones, up, right);
    return std::atan2(standing.cross(forward).norm(), standing.dot(forward)) * 180 / std::numbers::pi;
}

} // namespace

TEST_CASE("a foot that points forward does so whatever hip and knee do in the walking plane") {
    for (const double hip : {-30, 0, 30, 60, 90, 120})
        for (const double knee : {0, 5, 20, 45, 90, 130}) {
            INFO("hip " << hip << ", knee " << knee);
            CHECK(degrees_from_forward(leg(knee, hip)) < 1e-6);
        }
}

TEST_CASE("a leg turned out or in about its length is turned back") {
    for (const double angle : {-40, -10, 15, 45, 75})
        for (const double knee : {0, 40, 90}) {
            LegBones<double> bones = leg(knee, 0);
            const Eigen::Matrix3d rotation = turn(angle, up).toRotationMatrix();
            bones = {rotation * bones.thigh, rotation * bones.calf, rotation * bones.foot};
            INFO("turned by " << angle << ", knee " << knee);
            CHECK(degrees_from_forward(bones) < 1e-6);
        }
}

TEST_CASE("the length of the bones and the sense of the hip line do not matter") {
    LegBones<double> bones = leg(50, 30);
    const Eigen::Matrix3d rotation = (turn(25, up) * turn(20, forward)).toRotationMatrix();
    bones = {rotation * bones.thigh, rotation * bones.calf, rotation * bones.foot};
    const Vec3 expected = standing_foot_direction(bones, up, right);
    CHECK(expected.norm() == Approx(1));
    CHECK((standing_foot_direction(bones, up, Vec3(-right)) - expected).norm() < 1e-9);
    const LegBones<double> longer{3 * bones.thigh, 5 * bones.calf, 0.2 * bones.foot};
    CHECK((standing_foot_direction(longer, up, right) - expected).norm() < 1e-9);
}

TEST_CASE("the direction turns with the body") {
    LegBones<double> bones = leg(70, 40);
    bones.foot = turn(20, up) * bones.foot;
    const Vec3 expected = standing_foot_direction(bones, up, right);
    const Eigen::Matrix3d rotation = turn(130, Vec3(1, 2, 3).normalized()).toRotationMatrix();
    const LegBones<double> turned{rotation * bones.thigh, rotation * bones.calf, rotation * bones.foot};
    CHECK((standing_foot_direction(turned, Vec3(rotation * up), Vec3(rotation * right)) - rotation * expected).norm() <
          1e-9);
}

TEST_CASE("a foot that points backward is left pointing backward") {
    LegBones<double> bones = leg(0, 0);
    bones.foot = -bones.foot;
    CHECK(degrees_from_forward(bones) == Approx(180));
}

TEST_CASE("in float, the direction is the same") {
    LegBones<double> bones = leg(50, 30);
    const Eigen::Matrix3d rotation = (turn(25, up) * turn(20, forward)).toRotationMatrix();
    bones = {rotation * bones.thigh, rotation * bones.calf, rotation * bones.foot};
    const LegBones<float> rounded{bones.thigh.cast<float>(), bones.calf.cast<float>(), bones.foot.cast<float>()};
    const Vector3<float> found =
        standing_foot_direction(rounded, Vector3<float>(up.cast<float>()), Vector3<float>(right.cast<float>()));
    CHECK((found.cast<double>() - standing_foot_direction(bones, up, right)).norm() < 1e-5);
}
