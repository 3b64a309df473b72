#include <skelgen/anatomy/impl/radii.hpp>

#include "anatomy/rest_skeleton.hpp"
#include "catch.hpp"

using namespace skelgen;
using namespace skelgen::anatomy;
using namespace skelgen::test;

TEMPLATE_TEST_CASE("a joint's radius is that of the tube around its bone", "", float, double) {
    using Vec = Vector3<TestType>;
    KinematicSkeleton<TestType> skeleton;
    skeleton.joints = {{"root", -1, Vec(0, 0, 1), 0}, {"next", 0, Vec(0, 0, 2), 0}, {"far", 1, Vec(0, 9, 9), 0}};
    skeleton = measure_radii(skeleton, body_of<TestType>(capsule(0.3, 4)));
    CHECK(skeleton.joints[0].radius == Approx(0.3).epsilon(0.02));
    CHECK(skeleton.joints[1].radius == Approx(0.3).epsilon(0.02));
    CHECK(skeleton.joints[2].radius == 0); // nothing around it
}

TEST_CASE("a skeleton of one joint has no bone to measure across") {
    const KinematicSkeleton<double> skeleton = measure_radii(joints_at(1, Vec3(0, 0, 1)), body_of(capsule(0.3, 4)));
    CHECK(skeleton.joints[0].radius == 0);
}
