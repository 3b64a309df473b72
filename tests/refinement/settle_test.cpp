#include <cmath>

#include <skelgen/core/error.hpp>
#include <skelgen/io/template_json.hpp>
#include <skelgen/refinement/settle.hpp>

#include "catch.hpp"
#include "shapes.hpp"

using namespace skelgen;
using namespace skelgen::test;

namespace {

/// human21 in its rest pose.
KinematicSkeleton<double> rest_skeleton() {
    KinematicSkeleton<double> out;
    for (const TemplateJoint& joint : builtin_template("human21").joints)
        out.joints.push_back(
            {joint.name, joint.parent, Vec3(-joint.position.x(), joint.position.y(), joint.position.z()), 0});
    return out;
}

Vec3 at(const KinematicSkeleton<double>& skeleton, const std::string& name) {
    return skeleton.joints[static_cast<std::size_t>(find_joint(skeleton, name))].position;
}

Vec3& at(KinematicSkeleton<double>& skeleton, const std::string& name) {
    return skeleton.joints[static_cast<std::size_t>(find_joint(skeleton, name))].position;
}

double length(const KinematicSkeleton<double>& skeleton, const std::string& a, const std::string& b) {
    return (at(skeleton, a) - at(skeleton, b)).norm();
}

/// A curve along the axis of a capsule from z = 0 to 4.
CurveSkeleton<double> axis_curve() {
    CurveSkeleton<double> curve;
    curve.nodes.resize(3, 3);
    curve.nodes << 0, 0, 0, 0, 0, 2, 0, 0, 4;
    return curve;
}

} // namespace

TEST_CASE(
    "knees move to the front and outwards, shoulders to the front, the neck to the back, by the same on both sides") {
    const KinematicSkeleton<double> before = rest_skeleton();
    KinematicSkeleton<double> after = before;
    move_to_bones(after, builtin_template("human21"));
    const Vec3 left = at(after, "left_knee") - at(before, "left_knee"),
               right = at(after, "right_knee") - at(before, "right_knee");
    CHECK(left.y() > 0.004);
    CHECK(left.x() < -0.003); // in space a person who looks along y has the left at -x
    CHECK(right.x() == Approx(-left.x()));
    CHECK(right.y() == Approx(left.y()));
    CHECK((at(after, "neck") - at(before, "neck")).y() < -0.004);
    CHECK(left.norm() < 0.03);
    CHECK((at(after, "left_shoulder") - at(before, "left_shoulder")).y() > 0.004);
    CHECK(length(after, "left_shoulder", "left_elbow") < length(before, "left_shoulder", "left_elbow"));
    CHECK(length(after, "right_hip", "right_ankle") < length(before, "right_hip", "right_ankle"));
    for (const char* name : {"crotch", "head", "left_elbow", "left_ankle", "right_foot"})
        CHECK(at(after, name) == at(before, name));
}

TEST_CASE("a knee bent at a right angle moves towards the ankle alone") {
    KinematicSkeleton<double> skeleton = rest_skeleton();
    const Vec3 knee = at(skeleton, "left_knee");
    at(skeleton, "left_ankle") = knee + Vec3(0, -0.41, 0);
    at(skeleton, "left_foot") = knee + Vec3(0, -0.41, -0.13);
    move_to_bones(skeleton, builtin_template("human21"));
    const Vec3 moved = at(skeleton, "left_knee") - knee;
    const Vec3 along = Vec3(0, -1, -1).normalized(); // halfway between thigh and calf, outwards
    CHECK(moved.dot(along) > 0.01);
    CHECK((moved - moved.dot(along) * along).norm() < 0.001);
}

TEST_CASE("joints of likely bones are trusted, those of unlikely ones are not, and the worst are named") {
    KinematicSkeleton<double> skeleton = rest_skeleton();
    skeleton.quality.sides_confidence = 1;
    CHECK(judge_joints(skeleton, builtin_template("human21")) == 0);
    CHECK(skeleton.quality.sides_confidence == 1);
    for (const Joint<double>& joint : skeleton.joints) CHECK(joint.confidence == Approx(1));
    CHECK(skeleton.quality.warnings.empty());

    at(skeleton, "left_knee") += Vec3(0, 0, 0.05);
    at(skeleton, "right_hand") =
        at(skeleton, "right_wrist") + 3 * (at(skeleton, "right_hand") - at(skeleton, "right_wrist"));
    judge_joints(skeleton, builtin_template("human21"));
    const auto confidence = [&](const char* name) {
        return skeleton.joints[static_cast<std::size_t>(find_joint(skeleton, name))].confidence;
    };
    CHECK(skeleton.quality.sides_confidence == Approx(0.75)); // a misplaced hand may be the other one
    CHECK(confidence("left_knee") < 0.6);
    CHECK(confidence("right_hand") < 0.1);
    CHECK(confidence("right_wrist") < 0.1);
    CHECK(confidence("left_shoulder") == Approx(1));
    CHECK(confidence("neck") == Approx(1));
    std::string all;
    for (const std::string& warning : skeleton.quality.warnings) all += warning + '\n';
    CHECK(all.find("right_hand") != std::string::npos);
    CHECK(all.find("left_shoulder") == std::string::npos);
}

TEST_CASE("bones of both sides get like lengths, with the least movement") {
    KinematicSkeleton<double> skeleton = rest_skeleton();
    const KinematicSkeleton<double> even = skeleton;
    balance_bones(skeleton, builtin_template("human21"));
    for (std::size_t j = 0; j < skeleton.joints.size(); ++j)
        CHECK((skeleton.joints[j].position - even.joints[j].position).norm() < 1e-12);

    at(skeleton, "left_knee") += Vec3(0, 0, 0.04);
    const Vec3 right_elbow = at(skeleton, "right_elbow");
    balance_bones(skeleton, builtin_template("human21"));
    for (const auto& [a, b] : {std::pair("hip", "knee"), std::pair("knee", "ankle")}) {
        const double ratio = length(skeleton, std::string("left_") + a, std::string("left_") + b) /
                             length(skeleton, std::string("right_") + a, std::string("right_") + b);
        INFO(a << " to " << b);
        CHECK(std::abs(std::log(ratio)) < 0.05);
    }
    CHECK(at(skeleton, "right_elbow") == right_elbow);
    CHECK((at(skeleton, "left_knee") - at(even, "left_knee")).norm() < 0.04);
}

TEST_CASE("a bone that is half as long as its counterpart has been missed: the counterpart stays as it is") {
    KinematicSkeleton<double> skeleton = rest_skeleton();
    at(skeleton, "left_hand") = 0.5 * (at(skeleton, "left_wrist") + at(skeleton, "left_hand"));
    const Vec3 right_hand = at(skeleton, "right_hand");
    balance_bones(skeleton, builtin_template("human21"));
    CHECK(at(skeleton, "right_hand") == right_hand);
}

TEST_CASE("a joint outside is moved in and reported, one inside stays") {
    const Mesh mesh = capsule(0.3, 4);
    KinematicSkeleton<double> skeleton;
    skeleton.joints.assign(6, {"inside", -1, Vec3(0.1, 0, 1), 0});
    skeleton.joints[3] = {"outside", 0, Vec3(0.5, 0, 2.1), 0};
    keep_inside(skeleton, mesh, axis_curve());
    CHECK(skeleton.joints[0].position == Vec3(0.1, 0, 1));
    CHECK(skeleton.joints[3].position.head<2>().norm() < 0.3);
    CHECK((skeleton.joints[3].position - Vec3(0.5, 0, 2.1)).norm() < 0.35); // no farther than it takes
    REQUIRE(skeleton.quality.warnings.size() == 1);
    CHECK(skeleton.quality.warnings[0].find("outside") != std::string::npos);
}

TEST_CASE("with more than one joint in six outside it is no body") {
    const Mesh mesh = capsule(0.3, 4);
    KinematicSkeleton<double> skeleton;
    skeleton.joints.assign(11, {"inside", -1, Vec3(0.1, 0, 1), 0});
    skeleton.joints[3].position = Vec3(0.5, 0, 2.1);
    CHECK_NOTHROW(keep_inside(skeleton, mesh, axis_curve()));
    skeleton.joints[3].position = skeleton.joints[4].position = Vec3(0.5, 0, 2.1);
    CHECK_THROWS_AS(keep_inside(skeleton, mesh, axis_curve()), Error);
}

TEST_CASE("a joint's radius is that of the tube around its bone") {
    const Mesh mesh = capsule(0.3, 4);
    KinematicSkeleton<double> skeleton;
    skeleton.joints = {{"root", -1, Vec3(0, 0, 1), 0}, {"next", 0, Vec3(0, 0, 2), 0}, {"far", 1, Vec3(0, 9, 9), 0}};
    measure_radii(skeleton, mesh);
    CHECK(skeleton.joints[0].radius == Approx(0.3).epsilon(0.02));
    CHECK(skeleton.joints[1].radius == Approx(0.3).epsilon(0.02));
    CHECK(skeleton.joints[2].radius == 0); // nothing around it
}
