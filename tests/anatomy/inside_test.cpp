#include <skelgen/anatomy/inside.hpp>

#include "anatomy/rest_skeleton.hpp"
#include "catch.hpp"

using namespace skelgen;
using namespace skelgen::anatomy;
using namespace skelgen::test;

TEMPLATE_TEST_CASE("a joint outside is moved in and reported, one inside stays", "", float, double) {
    const Vector3<TestType> within(TestType(0.1), 0, 1), outside(TestType(0.5), 0, TestType(2.1));
    KinematicSkeleton<TestType> skeleton = joints_at(8, within);
    skeleton.joints[3] = {"outside", 0, outside, 0};
    const auto found = move_inside(skeleton, body_of<TestType>(capsule(0.3, 4)), axis_curve<TestType>());
    REQUIRE(found);
    CHECK(found->moved == std::vector<int>{3});
    const std::vector<Joint<TestType>>& joints = found->skeleton.joints;
    for (const std::size_t j : {0, 1, 2, 4, 5, 6, 7}) CHECK(joints[j].position == within);
    CHECK(joints[3].position.template head<2>().norm() < 0.3);
    CHECK((joints[3].position - outside).norm() < 0.35); // no farther than it takes
    REQUIRE(found->skeleton.quality.warnings.size() == 1);
    CHECK(found->skeleton.quality.warnings[0] == "joint outside was outside the surface and has been moved in");
}

TEST_CASE("with more than one joint in eight outside it is no match") {
    const Body<double> body = body_of(capsule(0.3, 4));
    KinematicSkeleton<double> skeleton = joints_at(15, Vec3(0.1, 0, 1));
    skeleton.joints[3].position = Vec3(0.5, 0, 2.1);
    CHECK(move_inside(skeleton, body, axis_curve()));
    skeleton.joints[4].position = skeleton.joints[3].position;
    const auto found = move_inside(skeleton, body, axis_curve());
    REQUIRE_FALSE(found);
    CHECK(found.failure().reason == FailureReason::no_match);
    CHECK(found.failure().what == "no human body: 2 joints of its skeleton would lie outside of it");
}
