#include <cmath>

#include "catch.hpp"
#include "refinement/bone_line.hpp"

using namespace skelgen;

namespace {

/// Sections of thickness 0.1 every 0.05 along the x axis, from 0 to 1.
Centreline straight_limb() {
    constexpr Eigen::Index n = 21;
    Centreline limb;
    limb.arc = Eigen::VectorXd::LinSpaced(n, 0, 1);
    limb.points = Points<double>::Zero(n, 3);
    limb.points.col(0) = limb.arc;
    limb.thickness = limb.area = Eigen::VectorXd::Constant(n, 0.1);
    limb.flatness = Eigen::VectorXd::Zero(n);
    return limb;
}

} // namespace

TEST_CASE("a bone is the line through its sections' centres, pointing outwards") {
    const auto bone = detail::fit_bone(straight_limb(), 0.1, 0.9, 0.1);
    REQUIRE(bone);
    CHECK((bone->direction - Vector3<double>::UnitX()).norm() < 1e-12);
    CHECK(std::hypot(bone->point.y(), bone->point.z()) < 1e-12);
}

TEST_CASE("sections across a fold do not turn the bone") {
    Centreline limb = straight_limb();
    for (Eigen::Index i = 14; i < 19; ++i) limb.points(i, 1) = 0.1 + 0.03 * static_cast<double>(i - 14);
    const auto bone = detail::fit_bone(limb, 0, 1, 0.1);
    REQUIRE(bone);
    CHECK((bone->direction - Vector3<double>::UnitX()).norm() < 1e-12);
}

TEST_CASE("sections that are not of a cylinder do not count, and a bone needs three that do") {
    Centreline limb = straight_limb();
    for (Eigen::Index i = 0; i < limb.arc.size(); ++i) {
        limb.points(i, 2) = i % 2 ? 0.04 : 0.0;
        limb.flatness[i] = i % 2 ? 0.2 : 0.05;
    }
    const auto bone = detail::fit_bone(limb, 0, 1, 0.1);
    REQUIRE(bone);
    CHECK(std::abs(bone->direction.z()) < 1e-12);
    CHECK(detail::fit_bone(limb, 0.2, 0.4, 0.1));
    CHECK_FALSE(detail::fit_bone(limb, 0.2, 0.39, 0.1));
    CHECK_FALSE(detail::fit_bone(limb, 0.2, 0.4, 0.01));
}

TEST_CASE("lines meet half way between where they are nearest, parallel ones nowhere") {
    const detail::Line along{Vector3<double>(0, 0, 0), Vector3<double>::UnitX()};
    const detail::Line across{Vector3<double>(2, 5, 1), Vector3<double>::UnitY()};
    const auto meeting = detail::meeting_point(along, across);
    REQUIRE(meeting);
    CHECK((*meeting - Vector3<double>(2, 0, 0.5)).norm() < 1e-12);
    CHECK_FALSE(detail::meeting_point(along, {Vector3<double>(0, 1, 0), Vector3<double>::UnitX()}));
}
