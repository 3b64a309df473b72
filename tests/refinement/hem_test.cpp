#include <algorithm>
#include <array>
#include <cmath>

#include <skelgen/refinement/impl/hem.hpp>

#include "catch.hpp"
#include "limb_shapes.hpp"

using namespace skelgen;
using namespace skelgen::refinement;
using namespace skelgen::test;

namespace {

using enum JointRole;

constexpr double hem_height = 0.6, girth = 0.26;

/// A trunk, an upright cylinder that ends below at `hem_height`, and two legs of that radius that leave it there and
/// end `ahead` of it; or that go straight down to knees where they are folded.
template <typename Scalar>
bool is_hem_of(double leg_radius, double ahead, double waist_girth = 0.85 * girth, bool is_folded = false) {
    const auto top = [](double side) { return Vec3(0.13 * side, 0, hem_height + 0.1); };
    const auto tip = [&](double side) {
        return Vec3(0.13 * side, ahead, ahead > 0.5 ? hem_height - 0.15 : is_folded ? 0.3 : 0);
    };
    const auto knee_at = [&](double side) {
        return is_folded ? Vec3(0.13 * side, 0, 0.1) : (top(side) + tip(side)) / 2;
    };
    const auto field = [&](const Vec3& p) {
        const double trunk = std::max({std::hypot(p.x(), p.y()) - girth, hem_height - p.z(), p.z() - 1.6});
        const auto leg = [&](double side) {
            return std::min(segment_distance(p, top(side), knee_at(side)),
                            segment_distance(p, knee_at(side), tip(side)));
        };
        const double legs = std::min(leg(1), leg(-1)) - leg_radius;
        return std::min(trunk, legs);
    };
    const Body<Scalar> body = body_of<Scalar>(level_set(field, Vec3(-0.4, -0.4, -0.25), Vec3(0.4, 1.3, 1.7), 0.03));
    const auto leg = [&](Side side) {
        const double sign = side == Side::left ? 1 : -1, calf = (knee_at(sign) - tip(sign)).norm();
        return limb_along<Scalar>(
            {top(sign), knee_at(sign), tip(sign)},
            {joint_of(hip, side), joint_of(knee, side), joint_of(ankle, side), joint_of(foot, side)},
            {(top(sign) - knee_at(sign)).norm() + calf, calf, 0.1, 0.05});
    };
    const Limb<Scalar> left = leg(Side::left), right = leg(Side::right);
    const EndPoint<Scalar> left_end = end_point_near(body, tip(1)), right_end = end_point_near(body, tip(-1));
    TrunkAxis<Scalar> axis{Vector3<Scalar>(0, 0, Scalar(1)), Vector3<Scalar>::UnitZ(),
                           Vec3(0, 0, hem_height).cast<Scalar>()};
    axis.largest_section = static_cast<Scalar>(1.6 * pi * waist_girth * waist_girth);
    return is_hem<Scalar>(Slicer<Scalar>(body), {LegToEnd<Scalar>{left, left_end}, LegToEnd<Scalar>{right, right_end}},
                          axis, Scalar(0.4));
}

} // namespace

TEMPLATE_TEST_CASE("a trunk that ends in legs of half its section or less ends in a hem", "", float, double) {
    const double half = girth / 2; // of the trunk's radius: both legs have half of its section
    CHECK(is_hem_of<TestType>(0.9 * half, 0));
    CHECK(is_hem_of<TestType>(0.5 * half, 0.2));
    CHECK_FALSE(is_hem_of<TestType>(1.05 * half, 0)); // 1.8 times the legs' sections
}

TEST_CASE("legs that are raised show no hem, nor do thighs before a slender trunk, nor one that ends flat") {
    CHECK_FALSE(is_hem_of<double>(0.06, 1));
    CHECK_FALSE(is_hem_of<double>(0.06, 0, 0.6 * girth));
    CHECK_FALSE(is_hem_of<double>(0.06, 0, girth));
    CHECK(is_hem_of<double>(0.06, 0.25));
    CHECK_FALSE(is_hem_of<double>(0.06, 0.25, 0.85 * girth, true)); // the same, but squatting
}
