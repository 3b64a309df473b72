#include <cmath>

#include <skelgen/refinement/bone_line.hpp>

#include "catch.hpp"
#include "limb_shapes.hpp"

using namespace skelgen;
using namespace skelgen::refinement;
using namespace skelgen::test;

namespace {

/// Sections of thickness 0.1 every 0.05 along the x axis, from 0 to 1.
template <typename Scalar = double>
Centreline<Scalar> straight_limb() {
    return limb_along<Scalar>({Vec3::Zero(), Vec3::UnitX()}, {}, {}, 0.1, 0.05).line;
}

} // namespace

TEST_CASE("a bone is the line through its sections' centres, pointing outwards") {
    const auto bone = fit_bone(straight_limb(), 0.1, 0.9);
    REQUIRE(bone);
    CHECK((bone->direction - Vec3::UnitX()).norm() < 1e-12);
    CHECK(std::hypot(bone->point.y(), bone->point.z()) < 1e-12);
}

TEST_CASE("sections across a fold do not turn the bone") {
    Centreline limb = straight_limb();
    for (Eigen::Index i = 14; i < 19; ++i) limb.points(i, 1) = 0.1 + 0.03 * static_cast<double>(i - 14);
    const auto bone = fit_bone(limb, 0.0, 1.0);
    REQUIRE(bone);
    CHECK((bone->direction - Vec3::UnitX()).norm() < 1e-12);
}

TEST_CASE("sections that are not of a cylinder do not count, and a bone needs three that do") {
    Centreline limb = straight_limb();
    for (Eigen::Index i = 0; i < limb.arc.size(); ++i) {
        limb.points(i, 2) = i % 2 ? 0.04 : 0.0;
        limb.flatness[i] = i % 2 ? 0.2 : 0.05;
    }
    const auto bone = fit_bone(limb, 0.0, 1.0);
    REQUIRE(bone);
    CHECK(std::abs(bone->direction.z()) < 1e-12);
    CHECK(fit_bone(limb, 0.2, 0.4));
    CHECK_FALSE(fit_bone(limb, 0.2, 0.39));
    CHECK_FALSE(fit_bone(limb, 0.2, 0.4, {0.01}));
}

TEST_CASE("lines meet half way between where they are nearest, parallel ones nowhere") {
    const Line<double> along{Vec3(0, 0, 0), Vec3::UnitX()}, across{Vec3(2, 5, 1), Vec3::UnitY()};
    const auto meeting = meeting_point(along, across);
    REQUIRE(meeting);
    CHECK((*meeting - Vec3(2, 0, 0.5)).norm() < 1e-12);
    CHECK_FALSE(meeting_point(along, {Vec3(0, 1, 0), Vec3::UnitX()}));
}

TEST_CASE("lines a degree from parallel meet nowhere, lines three degrees from it where they do") {
    const Line<double> along{Vec3::Zero(), Vec3::UnitX()};
    const auto turned = [](double degrees) {
        const double angle = degrees * pi / 180;
        return Line<double>{Vec3(1, 0, 0), Vec3(std::cos(angle), std::sin(angle), 0)};
    };
    CHECK_FALSE(meeting_point(along, turned(1)));
    REQUIRE(meeting_point(along, turned(3)));
    CHECK((*meeting_point(along, turned(3)) - Vec3::UnitX()).norm() < 1e-12);
}

TEMPLATE_TEST_CASE("a limb's first bone is told by its sections between the trunk and the next joint", "", float,
                   double) {
    // Out of a trunk along y, a thigh along x from 0 to 1 (hip at 0, knee at 1), a calf along z. Between trunk and
    // thigh the centreline turns; of the knee's last tenth and of all before the attachment nothing may be heard.
    auto leg = limb_along<TestType>({Vec3(0, -0.5, 0), Vec3::Zero(), Vec3::UnitX(), Vec3(1, 0, 1)}, {0, 1}, {2, 1});
    leg.attachment = TestType(0.6);
    const auto bone = fit_first_bone(leg);
    REQUIRE(bone);
    const TestType tolerance = 16 * std::numeric_limits<TestType>::epsilon();
    CHECK((bone->direction - Vector3<TestType>::UnitX()).norm() < tolerance);
    CHECK(bone->point.template tail<2>().norm() < tolerance);
    CHECK(bone->point.x() == Approx((0.15 + 0.85) / 2).margin(0.011)); // the middle of what counts
    leg.line.flatness.setConstant(1);
    CHECK_FALSE(fit_first_bone(leg));
}
