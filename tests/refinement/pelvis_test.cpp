#include <cmath>
#include <limits>
#include <optional>

#include <skelgen/refinement/fork.hpp>
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

/// A trunk along z from (0, 0, 1), and from there two legs, each this far to its side, ahead (along y) and down.
template <typename Scalar>
struct Figure {
    Body<Scalar> body;
    Vec3 fork;

    explicit Figure(const Vec3& leg) {
        const Vec3 top(0, 0, 1), left = top + leg, right = top + Vec3(-leg.x(), leg.y(), leg.z());
        body = body_of<Scalar>(tubes({{top, left}, {top, right}, {top, Vec3(0, 0, 2)}}, 0.12, 0.04));
        fork =
            fork_between(body.mesh, end_point_near(body, left), end_point_near(body, right))->template cast<double>();
    }

    [[nodiscard]] std::optional<TrunkAxis<Scalar>> axis() const {
        Points<double> line(4, 3);
        line << fork.transpose(), 0, 0, 1, 0.03, 0.02, 1.3, 0, 0, 1.9;
        return find_trunk_axis(Slicer<Scalar>(body), Points<Scalar>(line.cast<Scalar>()), static_cast<Scalar>(thigh));
    }
};

/// Hips 0.142 apart beside the axis and off its middle; thighs of `length` hang from (+-0.071, 0, hips) downwards, the
/// feet point along y.
template <typename Scalar>
struct Standing {
    Placement<Scalar> placement{builtin_template("human21"), 1};
    std::vector<Limb<Scalar>> limbs;

    Standing(double hips, double length) {
        for (const Side side : {Side::left, Side::right}) {
            const double x = side == Side::left ? 0.071 : -0.071;
            const Vec3 knee_at(x, 0, hips - length), ankle_at = knee_at - 0.4 * Vec3::UnitZ();
            limbs.push_back(limb_along<Scalar>({Vec3(x, 0, hips), ankle_at, ankle_at + 0.2 * Vec3::UnitY()},
                                               {joint_of(hip, side), joint_of(knee, side), joint_of(ankle, side)},
                                               {0.6 + length, 0.6, 0.2}));
            placement.put(joint_of(hip, side), Vec3(x + 0.02, 0.03, hips + 0.05).cast<Scalar>());
            placement.put(joint_of(knee, side), knee_at.cast<Scalar>());
            placement.put(joint_of(ankle, side), ankle_at.cast<Scalar>());
        }
    }
};

} // namespace

TEMPLATE_TEST_CASE("the lower trunk's axis runs through its middle, and legs held forward turn it little", "", float,
                   double) {
    const double held_forward = 0.3; // of the leg's height, 17 degrees
    for (const double ahead : {0.0, held_forward}) {
        INFO("legs held forward by " << ahead);
        const Figure<TestType> figure(Vec3(0.3, ahead, -1));
        const auto axis = figure.axis();
        REQUIRE(axis);
        CHECK(std::hypot(axis->place.x(), axis->place.y()) < 0.02 + 0.2 * ahead);
        CHECK(axis->up.z() > std::cos(0.1 + ahead));
        CHECK(axis->place.z() > figure.fork.z() + 0.4 * thigh);
        CHECK(axis->fork == figure.fork.template cast<TestType>());
    }
}

TEST_CASE("a line that passes the body by has no axis") {
    const Body<double> body = body_of<double>(tubes({{Vec3(3, 0, 0), Vec3(3, 0, 0.1)}}, 0.1, 0.05));
    Points<double> line(2, 3);
    line << 0, 0, 0, 0, 0, 1;
    CHECK_FALSE(find_trunk_axis(Slicer<double>(body), line, thigh).has_value());
}

TEMPLATE_TEST_CASE("hips go level to the axis, to the height that fork and thighs agree on, the root above them", "",
                   float, double) {
    const TestType tolerance = 64 * std::numeric_limits<TestType>::epsilon();
    const double hips = 0.7 + 0.15 * thigh;
    const Standing<TestType> body(hips, 0.4);
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
    const double by_fork = 0.7 + 0.15 * thigh;
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

TEST_CASE("the pelvis's own up leans back from the trunk's line, away from where feet and thighs point") {
    const TrunkAxis<double> axis{Vec3(0, 0, 1), Vec3::UnitZ(), Vec3(0, 0, 0.7)};
    const Standing<double> body(0.8, 0.4);
    PelvisOptions options;
    options.tilt = 0.2;
    options.thigh_deviation = 100; // the fork alone
    const auto placed = place_pelvis(body.placement, body.limbs, axis, options);
    REQUIRE(placed);
    const Vec3 up = Vec3(0, -0.2, 1).normalized();
    const Vec3 middle = axis.place - (0.3 * up.z() - 0.15 * thigh) * up;
    CHECK((0.5 * (placed->at(left_hip) + placed->at(right_hip)) - middle).norm() < 1e-6);
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
