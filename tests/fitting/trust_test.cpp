#include <skelgen/fitting/trust.hpp>

#include "catch.hpp"

using namespace skelgen;

TEST_CASE("what is trusted less is trusted less in its sides and every joint, and lies where it did") {
    KinematicSkeleton<double> skeleton;
    skeleton.quality.sides_confidence = 0.8;
    for (const double confidence : {1.0, 0.5, 0.0}) {
        Joint<double> joint;
        joint.confidence = confidence;
        joint.position = {confidence, 1, 2};
        skeleton.joints.push_back(joint);
    }
    const KinematicSkeleton<double> less = fitting::less_certain(skeleton, 0.75);
    CHECK(less.quality.sides_confidence == Approx(0.6));
    CHECK(less.joints[0].confidence == Approx(0.75));
    CHECK(less.joints[1].confidence == Approx(0.375));
    CHECK(less.joints[2].confidence == 0);
    for (std::size_t j = 0; j < 3; ++j) CHECK(less.joints[j].position == skeleton.joints[j].position);
}
