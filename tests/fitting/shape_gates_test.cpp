// What is no body's shape is refused before joints are looked for, with the reason.

#include <cstddef>
#include <string>

#include <skelgen/core/builtin_templates.hpp>
#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/fitting/shape_gates.hpp>
#include <skelgen/surface/prepare.hpp>

#include "catch.hpp"
#include "shapes.hpp"

using namespace skelgen;
using namespace skelgen::fitting;
using namespace skelgen::test;

namespace {

/// The template's rest pose as a skeleton whose joints are so thick.
KinematicSkeleton<double> resting(const SkeletonTemplate& human, double radius) {
    KinematicSkeleton<double> skeleton;
    for (const TemplateJoint& joint : human.joints) {
        Joint<double> out;
        out.name = joint.name;
        out.position = joint.position;
        out.radius = radius;
        skeleton.joints.push_back(out);
    }
    return skeleton;
}

Joint<double>& joint_of(KinematicSkeleton<double>& skeleton, const std::string& name) {
    for (Joint<double>& joint : skeleton.joints)
        if (joint.name == name) return joint;
    FAIL("no joint " + name);
    return skeleton.joints.front();
}

} // namespace

TEST_CASE("what reaches as far as a person passes, a ball and a pole are refused for what they are") {
    CHECK_FALSE(not_slender(1.5, least_of_adults));
    const auto compact = not_slender(0.9, least_of_standing_figures);
    REQUIRE(compact);
    CHECK(compact->reason == FailureReason::no_body);
    CHECK(compact->what.find("compact") != std::string::npos);
    const auto pole = not_slender(2.3, least_of_adults);
    REQUIRE(pole);
    CHECK(pole->reason == FailureReason::too_long);
    CHECK(pole->what.find("thin and long") != std::string::npos);
    CHECK(not_slender(1.2, least_of_adults));
    CHECK_FALSE(not_slender(1.2, least_of_figures));
}

TEST_CASE("a ball is known to be too compact without its curve, in any unit; a long capsule is not") {
    for (const double size : {0.01, 1.0, 1000.0}) {
        INFO(size);
        CHECK(too_compact(surface::prepare(sphere(size))));
        CHECK_FALSE(too_compact(surface::prepare(capsule(0.1 * size, 1.5 * size))));
    }
}

TEST_CASE("of the curve, some may belong to no limb, not much") {
    CHECK_FALSE(not_all_matched(0.0));
    CHECK_FALSE(not_all_matched(0.3));
    const auto much = not_all_matched(0.45);
    REQUIRE(much);
    CHECK(much->reason == FailureReason::no_body);
}

TEST_CASE("limbs that stand free pass, a knee in the other thigh or an elbow in the trunk does not") {
    const SkeletonTemplate& human = builtin_template("human21");
    const double radius = 0.02 * human.joint(0).position.norm() + 0.02;
    const KinematicSkeleton<double> free = resting(human, radius);
    CHECK_FALSE(not_apart(free, human));

    KinematicSkeleton<double> knees = free;
    joint_of(knees, "left_knee").position =
        0.5 * (joint_of(knees, "right_hip").position + joint_of(knees, "right_knee").position);
    REQUIRE(not_apart(knees, human));
    CHECK(not_apart(knees, human)->reason == FailureReason::no_match);

    KinematicSkeleton<double> elbow = free;
    joint_of(elbow, "right_elbow").position =
        0.5 * (joint_of(elbow, "waist").position + joint_of(elbow, "chest").position);
    CHECK(not_apart(elbow, human));
    joint_of(elbow, "right_elbow").is_present = false;
    CHECK_FALSE(not_apart(elbow, human));
}

TEST_CASE("only a failure to match leaves other curves to try") {
    CHECK_FALSE(is_refused(Outcome<int>(1)));
    CHECK_FALSE(is_refused(Outcome<int>(Failure{FailureReason::no_match, ""})));
    CHECK(is_refused(Outcome<int>(Failure{FailureReason::no_body, ""})));
    CHECK(is_refused(Outcome<int>(Failure{FailureReason::too_long, ""})));
}
