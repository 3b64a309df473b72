#include <cmath>

#include <skelgen/refinement/hip_anchor.hpp>

#include "catch.hpp"
#include "limb_shapes.hpp"

using namespace skelgen;
using namespace skelgen::refinement;
using namespace skelgen::test;

namespace {

using enum JointRole;

constexpr double radius = 0.12, step = 0.04;

/// Legs that part at (0, 0, 1), their feet so far from the middle, under a trunk: mesh, limbs and their ends.
template <typename Scalar>
struct Fork {
    double apart;
    Body<Scalar> body;
    std::vector<Limb<Scalar>> limbs;
    std::vector<EndPoint<Scalar>> ends;

    explicit Fork(double feet_apart)
        : apart(feet_apart),
          body(body_of<Scalar>(tubes(
              {{Vec3(0, 0, 1), Vec3(apart, 0, 0)}, {Vec3(0, 0, 1), Vec3(-apart, 0, 0)}, {Vec3(0, 0, 1), Vec3(0, 0, 2)}},
              radius, step))) {
        for (const Side side : {Side::left, Side::right}) {
            const Vec3 end(side == Side::left ? apart : -apart, 0, 0);
            limbs.push_back(limb_along<Scalar>({Vec3(0, 0, 1), end},
                                               {joint_of(hip, side), joint_of(knee, side), joint_of(foot, side)},
                                               {length() - 0.25, length() - 0.65, 0.1}, radius));
            ends.push_back(end_point_near(body, Vec3(end - Vec3(0, 0, radius)), joint_of(foot, side)));
        }
        limbs.push_back(
            limb_along<Scalar>({Vec3(0, 0, 1), Vec3(0, 0, 2)}, {joint_of(neck), joint_of(head)}, {0.3, 0.1}, radius));
        ends.push_back(end_point_near(body, Vec3(0, 0, 2 + radius), joint_of(head)));
    }

    [[nodiscard]] double length() const { return std::hypot(1, apart); } ///< of a leg's axis

    [[nodiscard]] std::vector<Limb<Scalar>> anchored(const SkeletonTemplate& human, double scale) const {
        return anchor_hips(limbs, body.mesh, ends, human, static_cast<Scalar>(scale));
    }
};

} // namespace

TEMPLATE_TEST_CASE("a leg's top is where its line passes nearest to a place a sixth of a thigh above the fork", "",
                   float, double) {
    for (const double apart : {0.35, 0.6}) {
        const Fork<TestType> fork(apart);
        for (const double unit : {1.0, 100.0}) {
            const auto limbs = fork.anchored(scaled(builtin_template("human21"), unit), 0.9 / unit);
            const double thigh = 0.9 * (0.87 - 0.481), inner_sides_meet = 1 - radius * fork.length() / apart;
            const double hips = inner_sides_meet + 0.16 * thigh;
            const double to_tip = fork.length() - (1 - hips) / fork.length(); // along the leg's axis, by projection
            const double deviation = (0.03 + 0.15 * (1 - 1 / fork.length())) * 0.4;
            for (std::size_t leg : {0, 1}) {
                REQUIRE(limbs[leg].top_by_trunk.has_value());
                CHECK(*limbs[leg].top_by_trunk == Approx(to_tip).margin(1.5 * step));
                CHECK(limbs[leg].top_deviation == Approx(deviation).epsilon(0.05));
                CHECK(limbs[leg].from_tip == fork.limbs[leg].from_tip);
            }
            CHECK_FALSE(limbs[2].top_by_trunk.has_value());
        }
    }
}

TEST_CASE("the trunk tells nothing of legs without a head, of one leg, or of thighs that do not show") {
    const SkeletonTemplate& human = builtin_template("human21");
    const auto told = [&](const Fork<double>& fork) {
        int count = 0;
        for (const Limb<double>& limb : fork.anchored(human, 0.9)) count += limb.top_by_trunk.has_value();
        return count;
    };
    const Fork<double> whole(0.5);
    CHECK(told(whole) == 2);
    Fork<double> changed = whole;
    changed.limbs.pop_back();
    changed.ends.pop_back();
    CHECK(told(changed) == 0);
    changed = whole;
    changed.limbs.erase(changed.limbs.begin());
    changed.ends.erase(changed.ends.begin());
    CHECK(told(changed) == 0);
    changed = whole;
    changed.limbs[0].line.flatness.setConstant(1);
    CHECK(told(changed) == 1); // the other one shows its thigh
    changed = whole;
    changed.limbs[0].from_tip[0] *= 1.5; // a leg that would be two thirds of the template's
    CHECK(told(changed) == 1);
}
