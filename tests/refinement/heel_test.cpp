#include <cmath>

#include <skelgen/refinement/impl/bend.hpp>
#include <skelgen/refinement/impl/bone_line.hpp>
#include <skelgen/refinement/impl/heel.hpp>

#include "catch.hpp"
#include "limb_shapes.hpp"

using namespace skelgen;
using namespace skelgen::refinement;
using namespace skelgen::test;

namespace {

using enum JointRole;

/// A leg from the hip at the origin down to a heel at z = -0.8, and a foot from there, which turns by so many degrees.
template <typename Scalar>
Limb<Scalar> leg(double degrees, double foot_length) {
    const double angle = degrees * pi / 180;
    const Vec3 heel(0, 0, -0.8), tip = heel + foot_length * Vec3(std::sin(angle), 0, -std::cos(angle));
    return limb_along<Scalar>({Vec3::Zero(), heel, tip},
                              {joint_of(hip, Side::left), joint_of(knee, Side::left), joint_of(ankle, Side::left),
                               joint_of(foot, Side::left)},
                              {0.95, 0.55, 0.15, 0.05});
}

template <typename Scalar>
Stretch<Scalar> rest() {
    return {Scalar(0.15), Scalar(0.55), Scalar(0.95)};
}

} // namespace

TEMPLATE_TEST_CASE("a heel is where the line of a leg turns, however long the foot", "", float, double) {
    for (const double foot_length : {0.1, 0.153, 0.3})
        for (const double degrees : {60.0, 90.0, 110.0}) {
            const auto heel = find_heel(leg<TestType>(degrees, foot_length), rest<TestType>());
            INFO("a foot of " << foot_length << ", turned by " << degrees);
            REQUIRE(heel.has_value());
            CHECK(heel->from_tip == Approx(foot_length).margin(0.004)); // sections are 0.01 apart
            CHECK(heel->bent == Approx(1));
        }
}

TEST_CASE("a heel that turns little counts for little, one that does not turn for nothing") {
    const auto half = find_heel(leg<double>(35, 0.2), rest<double>());
    REQUIRE(half.has_value());
    CHECK(half->bent == Approx(0.5).margin(0.05));
    CHECK_FALSE(find_heel(leg<double>(20, 0.2), rest<double>()).has_value());
    CHECK_FALSE(find_heel(leg<double>(0, 0.2), rest<double>()).has_value());
}

TEST_CASE("a leg of a few sections shows no heel") {
    CHECK_FALSE(find_heel(leg<double>(90, 0.2), Stretch<double>{0.01, 0.045, 0.08}).has_value());
}
