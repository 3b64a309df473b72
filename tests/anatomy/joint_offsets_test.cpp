#include <skelgen/anatomy/impl/joint_offsets.hpp>

#include "anatomy/rest_skeleton.hpp"
#include "catch.hpp"

using namespace skelgen;
using namespace skelgen::anatomy;
using namespace skelgen::test;

TEST_CASE(
    "knees move to the front and outwards, shoulders to the front, the neck to the back, by the same on both sides") {
    const KinematicSkeleton<double> before = rest_skeleton();
    const KinematicSkeleton<double> after = apply_joint_offsets(before, builtin_template("human21"));
    const Vec3 left = at(after, "left_knee") - at(before, "left_knee"),
               right = at(after, "right_knee") - at(before, "right_knee");
    CHECK(left.z() > 0.004);
    CHECK(left.x() > 0.003);
    CHECK(right.x() == Approx(-left.x()));
    CHECK(right.z() == Approx(left.z()));
    CHECK((at(after, "neck") - at(before, "neck")).z() < -0.004);
    CHECK(left.norm() < 0.03);
    CHECK((at(after, "left_shoulder") - at(before, "left_shoulder")).z() > 0.004);
    CHECK((at(after, "right_shoulder") - at(before, "right_shoulder")).z() ==
          Approx((at(after, "left_shoulder") - at(before, "left_shoulder")).z()));
    CHECK(length(after, "left_shoulder", "left_elbow") < length(before, "left_shoulder", "left_elbow"));
    for (const char* name : {"crotch", "left_hip", "right_hip", "head", "left_elbow", "left_ankle", "right_foot"})
        CHECK(at(after, name) == at(before, name));
}

TEST_CASE("a knee bent at a right angle moves towards the ankle alone") {
    KinematicSkeleton<double> skeleton = rest_skeleton();
    const Vec3 knee = at(skeleton, "left_knee");
    at(skeleton, "left_ankle") = knee + Vec3(0, 0, -0.41);
    at(skeleton, "left_foot") = knee + Vec3(0, -0.13, -0.41);
    skeleton = apply_joint_offsets(skeleton, builtin_template("human21"));
    const Vec3 moved = at(skeleton, "left_knee") - knee;
    const Vec3 along = Vec3(0, -1, -1).normalized(); // halfway between thigh and calf, outwards
    CHECK(moved.dot(along) > 0.01);
    CHECK((moved - moved.dot(along) * along).norm() < 0.001);
}

TEST_CASE("an elbow moves towards the wrist, the farther the more it is bent") {
    const auto moved = [](double degrees) {
        KinematicSkeleton<double> skeleton = rest_skeleton();
        const Vec3 elbow = at(skeleton, "left_elbow"), shoulder = at(skeleton, "left_shoulder");
        const Vec3 onwards = (elbow - shoulder).normalized(), aside = onwards.unitOrthogonal();
        const double angle = degrees * pi / 180;
        at(skeleton, "left_wrist") = elbow + 0.25 * (std::cos(angle) * onwards + std::sin(angle) * aside);
        const Vec3 along = (std::cos(angle / 2) * onwards + std::sin(angle / 2) * aside);
        skeleton = apply_joint_offsets(skeleton, builtin_template("human21"));
        const Vec3 off = at(skeleton, "left_elbow") - elbow;
        CHECK((off - off.dot(along) * along).norm() < 1e-12);
        return off.dot(along) / (elbow - shoulder).norm();
    };
    CHECK(moved(0) == Approx(0).margin(1e-12));
    CHECK(moved(60) == Approx(0.015));
    CHECK(moved(120) == Approx(0.03));
}

TEST_CASE("a neck goes with the shoulders, two thirds of the way sideways and a seventh upwards") {
    const auto moved = [](const Vec3& left, const Vec3& right) {
        KinematicSkeleton<double> skeleton = rest_skeleton();
        for (const char* name : {"left_shoulder", "left_elbow"}) at(skeleton, name) += left;
        for (const char* name : {"right_shoulder", "right_elbow"}) at(skeleton, name) += right;
        return at(apply_joint_offsets(skeleton, builtin_template("human21")), "neck");
    };
    const Vec3 none = Vec3::Zero(), up(0, 0.05, 0), aside(0.03, 0, 0);
    const Vec3 neck = moved(none, none);
    CHECK((moved(up, up) - neck - 0.15 * up).norm() < 1e-6);
    CHECK((moved(aside, aside) - neck - 0.66 * aside).norm() < 1e-6);
}

TEST_CASE("offsets turn and grow with the body") {
    const KinematicSkeleton<double> before = rest_skeleton();
    KinematicSkeleton<double> moved = before;
    const Eigen::Matrix3d rotation = Eigen::AngleAxisd(2.1, Vec3(1, 2, 3).normalized()).toRotationMatrix();
    for (Joint<double>& joint : moved.joints) joint.position = 7 * rotation * joint.position + Vec3(4, 5, 6);
    const auto expected = apply_joint_offsets(before, builtin_template("human21"));
    moved = apply_joint_offsets(moved, builtin_template("human21"));
    for (std::size_t j = 0; j < before.joints.size(); ++j)
        CHECK((7 * rotation * expected.joints[j].position + Vec3(4, 5, 6) - moved.joints[j].position).norm() < 1e-12);
}

TEST_CASE("in float, joints move to the same places") {
    const auto exact = apply_joint_offsets(rest_skeleton(), builtin_template("human21"));
    const auto rounded = apply_joint_offsets(rest_skeleton<float>(), builtin_template("human21"));
    for (std::size_t j = 0; j < exact.joints.size(); ++j)
        CHECK((rounded.joints[j].position.cast<double>() - exact.joints[j].position).norm() < 1e-6);
}

TEST_CASE("a template without neck and ankles moves the joints that it has") {
    const SkeletonTemplate& other = builtin_template("pinocchio18");
    KinematicSkeleton<double> skeleton;
    for (const TemplateJoint& joint : other.joints)
        skeleton.joints.push_back({joint.name, joint.parent, joint.position, 0});
    const KinematicSkeleton<double> after = apply_joint_offsets(skeleton, other);
    CHECK(at(after, "left_knee").z() > at(skeleton, "left_knee").z() + 0.004);
    CHECK(at(after, "left_shoulder") == at(skeleton, "left_shoulder")); // where it faces, the neck would tell
    CHECK(at(after, "head") == at(skeleton, "head"));
}
