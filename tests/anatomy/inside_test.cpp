#include <skelgen/anatomy/impl/inside.hpp>

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
    CHECK(found.moved == std::vector<int>{3});
    const std::vector<Joint<TestType>>& joints = found.skeleton.joints;
    for (const std::size_t j : {0, 1, 2, 4, 5, 6, 7}) CHECK(joints[j].position == within);
    CHECK(joints[3].position.template head<2>().norm() < 0.3);
    CHECK((joints[3].position - outside).norm() < 0.35); // no farther than it takes
    REQUIRE(found.skeleton.quality.warnings.size() == 1);
    CHECK(found.skeleton.quality.warnings[0] == "joint outside was outside the surface and has been moved in");
}

TEST_CASE("what is absent is not moved, however far outside it is, and however many are outside all are moved in") {
    const Body<double> body = body_of(capsule(0.3, 4));
    KinematicSkeleton<double> skeleton = joints_at(4, Vec3(0.5, 0, 2.1));
    skeleton.joints[2].is_present = false;
    const auto found = move_inside(skeleton, body, axis_curve());
    CHECK(found.moved == std::vector<int>{0, 1, 3});
    CHECK(found.skeleton.joints[2].position == skeleton.joints[2].position);
    for (const std::size_t j : {0, 1, 3}) CHECK(surface::is_inside(body, found.skeleton.joints[j].position));
    CHECK(found.skeleton.quality.warnings.size() == 3);
}
