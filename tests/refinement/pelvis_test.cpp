#include <cmath>
#include <limits>

#include <skelgen/refinement/pelvis.hpp>

#include "catch.hpp"
#include "limb_shapes.hpp"

using namespace skelgen;
using namespace skelgen::refinement;
using namespace skelgen::test;

namespace {

using enum JointRole;

const int left_hip = joint_of(hip, Side::left), right_hip = joint_of(hip, Side::right);
constexpr double thigh = 0.87 - 0.481; // of human21 at rest

/// Thighs of `length` hang from (+-0.071, 0, hips) downwards, the feet point along y; what the thighs' lines say the
/// hips are, 0.142 apart, is `off` from there.
template <typename Scalar>
struct Standing {
    Placement<Scalar> placement{builtin_template("human21"), 1};
    std::vector<Limb<Scalar>> limbs;

    static inline const Vec3 far = Vec3(0.02, 0.03, 1); ///< too far to be believed

    /// Thighs raised forward by these angles, radians.
    Standing(double hips, double length, double left_flexion = 0, double right_flexion = 0, const Vec3& off = far) {
        for (const Side side : {Side::left, Side::right}) {
            const double x = side == Side::left ? 0.071 : -0.071;
            const double flexion = side == Side::left ? left_flexion : right_flexion;
            const Vec3 knee_at = Vec3(x, 0, hips) + length * Vec3(0, std::sin(flexion), -std::cos(flexion));
            const Vec3 ankle_at = knee_at - 0.4 * Vec3::UnitZ();
            limbs.push_back(limb_along<Scalar>({Vec3(x, 0, hips), ankle_at, ankle_at + 0.2 * Vec3::UnitY()},
                                               {joint_of(hip, side), joint_of(knee, side), joint_of(ankle, side)},
                                               {0.6 + length, 0.6, 0.2}));
            placement.put(joint_of(hip, side), (Vec3(x, 0, hips) + off).cast<Scalar>());
            placement.put(joint_of(knee, side), knee_at.cast<Scalar>());
            placement.put(joint_of(ankle, side), ankle_at.cast<Scalar>());
        }
    }
};

} // namespace

TEMPLATE_TEST_CASE("hips go level to the axis, to the height that fork and thighs agree on, the root above them", "",
                   float, double) {
    const TestType tolerance = 64 * std::numeric_limits<TestType>::epsilon();
    const double hips = 0.7 + PelvisOptions{}.hips_above_fork * thigh;
    const Standing<TestType> body(hips, 0.4, 0, 0, Vec3(0, 0, 0.05));
    const TrunkAxis<TestType> axis{Vector3<TestType>(0, 0, 1), Vector3<TestType>::UnitZ(),
                                   Vec3(0.1, -0.1, 0.7).cast<TestType>()};
    PelvisOptions upright;
    upright.tilt = 0;
    const auto placed = place_pelvis(body.placement, body.limbs, axis, upright);
    REQUIRE(placed);
    CHECK((placed->at(left_hip) - Vec3(0.071, 0, hips).cast<TestType>()).norm() < tolerance);
    CHECK((placed->at(right_hip) - Vec3(-0.071, 0, hips).cast<TestType>()).norm() < tolerance);
    CHECK((placed->at(joint_of(pelvis)) - Vec3(0, 0, hips + 0.083).cast<TestType>()).norm() < tolerance);
}

TEST_CASE("where fork and thighs disagree, each counts by its precision, but a hem far from the hips for little") {
    const double by_fork = 0.7 + PelvisOptions{}.hips_above_fork * thigh;
    const TrunkAxis<double> axis{Vec3(0, 0, 1), Vec3::UnitZ(), Vec3(0, 0, 0.7)};
    PelvisOptions options;
    options.tilt = 0;
    options.fork_deviation = options.thigh_deviation = 0.05;
    const auto hips_with = [&](double by_thighs) {
        const Standing<double> body(by_thighs, 0.4);
        const auto placed = place_pelvis(body.placement, body.limbs, axis, options);
        REQUIRE(placed);
        return placed->at(left_hip).z();
    };
    CHECK(hips_with(by_fork + 0.001) == Approx(by_fork + 0.001 * 2 / 3).margin(1e-6));
    CHECK(hips_with(by_fork + 0.3) == Approx(by_fork + 0.3).margin(0.005));
}

TEST_CASE(
    "where a hem seems the fork, and the trunk's place lies below the hips, the root is above these all the same") {
    const double hips = GENERATE(0.9, 0.95, 1.0); // below, at and above the place
    const TrunkAxis<double> axis{Vec3(0, 0.01, 0.95), Vec3::UnitZ(), Vec3(0, 0, 0.7)};
    const Standing<double> body(hips, 0.4, 0, 0, Vec3(0, 0.02, 0));
    const auto placed = place_pelvis(body.placement, body.limbs, axis);
    REQUIRE(placed);
    const Vec3 middle = 0.5 * (placed->at(left_hip) + placed->at(right_hip));
    CHECK(middle.z() == Approx(hips).margin(0.03));
    const Vec3 to_root = placed->at(joint_of(pelvis)) - middle;
    CHECK(to_root.norm() == Approx(0.083).epsilon(1e-6));
    CHECK(to_root.z() > 0.95 * to_root.norm());
}

TEST_CASE("the pelvis's own up leans back from the trunk's line, away from where feet and thighs point") {
    const TrunkAxis<double> axis{Vec3(0, 0, 1), Vec3::UnitZ(), Vec3(0, 0, 0.7)};
    const Standing<double> body(0.8, 0.4);
    PelvisOptions options;
    options.tilt = 0.2;
    options.thigh_deviation = 100; // the fork alone
    const auto placed = place_pelvis(body.placement, body.limbs, axis, options);
    REQUIRE(placed);
    const Vec3 up = Vec3(0, -0.2, 1).normalized();
    const Vec3 middle = axis.place - (0.3 * up.z() - PelvisOptions{}.hips_above_fork * thigh) * up;
    CHECK((0.5 * (placed->at(left_hip) + placed->at(right_hip)) - middle).norm() < 1e-6);
}

TEST_CASE(
    "flexed thighs turn the pelvis back against the trunk by its part of what both are flexed, one alone does not") {
    const TrunkAxis<double> axis{Vec3(0, 0, 1), Vec3::UnitZ(), Vec3(0, 0, 0.7)};
    PelvisOptions options;
    options.tilt = 0;
    const auto turned_back = [&](double left, double right) {
        const Standing<double> body(0.76, thigh, left, right);
        const auto placed = place_pelvis(body.placement, body.limbs, axis, options);
        REQUIRE(placed);
        const Vec3 up = placed->at(joint_of(pelvis)) - 0.5 * (placed->at(left_hip) + placed->at(right_hip));
        CHECK(std::abs(up.x()) < 1e-9);
        return std::atan2(-up.y(), up.z());
    };
    const double sitting = 80 * pi / 180, walking = 30 * pi / 180;
    CHECK(turned_back(0, 0) == Approx(0).margin(1e-6));
    CHECK(turned_back(sitting, 0) == Approx(0).margin(1e-6));
    const double two = turned_back(sitting, sitting);
    CHECK(two == Approx(options.rhythm * sitting).epsilon(0.1));
    CHECK(turned_back(sitting, walking) < two);
    CHECK(turned_back(walking, sitting) == Approx(turned_back(sitting, walking)).margin(1e-6));
}

TEST_CASE(
    "the hips' line lies between that of the thighs and the trunk's sides, with the latter where the thighs' is off") {
    const double turn = 12 * pi / 180;
    TrunkAxis<double> axis{Vec3(0, 0, 1), Vec3::UnitZ(), Vec3(0, 0, 0.7),
                           0.4 * Vec3(std::cos(turn), std::sin(turn), 0)};
    const auto direction = [&](const Vec3& off) {
        const Standing<double> body(0.76, thigh, 0, 0, off);
        const auto placed = place_pelvis(body.placement, body.limbs, axis);
        REQUIRE(placed);
        const Vec3 line = placed->at(left_hip) - placed->at(right_hip);
        CHECK(line.norm() == Approx(0.142));
        CHECK(line.z() == Approx(0).margin(1e-9));
        return std::atan2(line.y(), line.x());
    };
    const double near = direction(Vec3::Zero()), far = direction(Vec3(0, 0.5, 0));
    CHECK(near > 0.2 * turn);
    CHECK(near < 0.6 * turn);
    CHECK(far > 0.9 * turn);
    CHECK(far < turn);
    axis.across = -axis.across; // of either sense
    CHECK(direction(Vec3::Zero()) == Approx(near).margin(1e-9));
    axis.across = Vec3::Zero();
    CHECK(direction(Vec3::Zero()) == Approx(0).margin(1e-9));
}

TEST_CASE(
    "the pelvis follows the middle between the thighs' hips off the trunk's line, the more the farther, not too far") {
    const TrunkAxis<double> axis{Vec3(0, 0, 1), Vec3::UnitZ(), Vec3(0, 0, 0.7)};
    PelvisOptions options;
    options.tilt = 0;
    struct Found {
        double share, slope, lean; // of the way to the thighs' hips; of the hips' line and of the pelvis, tangents
    };
    const auto found_at = [&](double aside) {
        const Standing<double> body(0.7 + options.hips_above_fork * thigh, thigh, 0, 0, Vec3(aside, 0, 0));
        const auto placed = place_pelvis(body.placement, body.limbs, axis, options);
        REQUIRE(placed);
        const Vec3 middle = 0.5 * (placed->at(left_hip) + placed->at(right_hip));
        const Vec3 line = placed->at(left_hip) - placed->at(right_hip), up = placed->at(joint_of(pelvis)) - middle;
        CHECK(std::abs(line.normalized().dot(up.normalized())) < 1e-6);
        return Found{middle.x() / aside, line.z() / line.x(), -up.x() / up.z()};
    };
    const Found little = found_at(0.005), plainly = found_at(0.06), wrongly = found_at(0.5);
    CHECK(little.share > 0.25);
    CHECK(little.share < 0.45);
    CHECK(plainly.share > 0.6);
    CHECK(plainly.share < 1);
    CHECK(std::abs(wrongly.share) < 0.02);
    CHECK(little.slope < 0.01);
    CHECK(plainly.slope > 0.03); // to the left the hips are off, so the trunk leans to the right
    CHECK(plainly.lean == Approx(plainly.slope).epsilon(0.01));
    CHECK(std::abs(wrongly.slope) < 0.01);
}

TEST_CASE("one leg, or hips along the axis, make no pelvis") {
    const TrunkAxis<double> axis{Vec3(0, 0, 1), Vec3::UnitZ(), Vec3(0, 0, 0.7)};
    const Standing<double> body(0.8, 0.4);
    CHECK_FALSE(place_pelvis(body.placement, {body.limbs[0]}, axis));
    Placement<double> upright = body.placement;
    upright.put(left_hip, Vec3(0, 0, 0.9));
    upright.put(right_hip, Vec3(0, 0, 0.8));
    CHECK_FALSE(place_pelvis(upright, body.limbs, axis));
}
