#include <cmath>

#include <skelgen/anatomy/impl/equal_bones.hpp>

#include "anatomy/rest_skeleton.hpp"
#include "catch.hpp"

using namespace skelgen;
using namespace skelgen::anatomy;
using namespace skelgen::test;

TEMPLATE_TEST_CASE("bones of both sides get like lengths, with the least movement", "", float, double) {
    const KinematicSkeleton<TestType> even = rest_skeleton<TestType>();
    KinematicSkeleton<TestType> skeleton = equalise_bones(even, builtin_template("human21")).skeleton;
    for (std::size_t j = 0; j < skeleton.joints.size(); ++j)
        CHECK((skeleton.joints[j].position - even.joints[j].position).norm() < 1e-12);

    skeleton = even;
    at(skeleton, "left_knee") += Vector3<TestType>(0, TestType(0.04), 0);
    skeleton = equalise_bones(skeleton, builtin_template("human21")).skeleton;
    for (const auto& [a, b] : {std::pair("hip", "knee"), std::pair("knee", "ankle")}) {
        const TestType ratio = length(skeleton, std::string("left_") + a, std::string("left_") + b) /
                               length(skeleton, std::string("right_") + a, std::string("right_") + b);
        INFO(a << " to " << b);
        CHECK(std::abs(std::log(ratio)) < 0.042); // from 0.2, with 0.04 allowed
    }
    CHECK(at(skeleton, "right_elbow") == at(even, "right_elbow"));
    CHECK((at(skeleton, "left_knee") - at(even, "left_knee")).norm() < 0.04);
}

TEST_CASE("a bone that is half as long as its counterpart has been missed: the counterpart stays as it is") {
    KinematicSkeleton<double> skeleton = rest_skeleton();
    at(skeleton, "left_hand") = 0.5 * (at(skeleton, "left_wrist") + at(skeleton, "left_hand"));
    const Vec3 right_hand = at(skeleton, "right_hand");
    skeleton = equalise_bones(skeleton, builtin_template("human21")).skeleton;
    CHECK(at(skeleton, "right_hand") == right_hand);
}

TEST_CASE("bones that start from the trunk stay as they are") {
    KinematicSkeleton<double> skeleton = rest_skeleton();
    for (const char* name : {"left_shoulder", "left_elbow", "left_wrist", "left_hand"})
        at(skeleton, name) += Vec3(0.03, 0, 0); // a longer collar bone
    const KinematicSkeleton<double> after = equalise_bones(skeleton, builtin_template("human21")).skeleton;
    for (const char* name : {"left_shoulder", "right_shoulder", "left_hand"})
        CHECK((at(after, name) - at(skeleton, name)).norm() < 1e-12);
}

TEST_CASE("the lengths that the body shows are kept") {
    KinematicSkeleton<double> skeleton = rest_skeleton<double>();
    const auto knee = static_cast<std::size_t>(find_joint(skeleton, "left_knee"));
    skeleton.joints[knee].position *= 1.02;
    const EqualBones<double> equal = equalise_bones(skeleton, builtin_template("human21"));
    CHECK(equal.measured == bone_lengths(skeleton));
    CHECK(equal.measured[0] == 0);
}
