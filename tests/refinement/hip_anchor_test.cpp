#include <cmath>

#include <skelgen/refinement/impl/hip_anchor.hpp>

#include "catch.hpp"
#include "limb_shapes.hpp"

using namespace skelgen;
using namespace skelgen::refinement;
using namespace skelgen::test;

namespace {

using enum JointRole;

/// Legs whose axes meet at (0, 0, 1), their feet so far from the middle, and the axis of a trunk above them.
template <typename Scalar>
struct Legs {
    double apart;
    std::vector<Limb<Scalar>> limbs;
    TrunkAxis<Scalar> axis{Vector3<Scalar>(0, 0, 1), Vector3<Scalar>::UnitZ(), Vec3(0.02, 0.05, 0.7).cast<Scalar>()};

    explicit Legs(double feet_apart) : apart(feet_apart) {
        for (const Side side : {Side::left, Side::right})
            limbs.push_back(limb_along<Scalar>({Vec3(0, 0, 1), Vec3(side == Side::left ? apart : -apart, 0, 0)},
                                               {joint_of(hip, side), joint_of(knee, side), joint_of(foot, side)},
                                               {length() - 0.25, length() - 0.65, 0.1}));
    }

    [[nodiscard]] double length() const { return std::hypot(1, apart); } ///< of a leg's axis

    [[nodiscard]] std::vector<Limb<Scalar>> anchored(const SkeletonTemplate& human, double scale) const {
        return anchor_hips(limbs, axis, human, static_cast<Scalar>(scale));
    }
};

} // namespace

TEMPLATE_TEST_CASE("a leg's top is where its line passes nearest to a place a sixth of a thigh above the fork", "",
                   float, double) {
    for (const double apart : {0.35, 0.6}) {
        const Legs<TestType> legs(apart);
        for (const double unit : {1.0, 100.0}) {
            const auto limbs = legs.anchored(scaled(builtin_template("human21"), unit), 0.9 / unit);
            const double thigh = 0.9 * (0.87 - 0.481), hips = 0.7 + 0.16 * thigh;
            const double to_tip = legs.length() - (1 - hips) / legs.length(); // along the leg's axis, by projection
            const double deviation = (0.03 + 0.15 * (1 - 1 / legs.length())) * 0.4;
            for (std::size_t leg : {0, 1}) {
                REQUIRE(limbs[leg].top_by_trunk.has_value());
                CHECK(*limbs[leg].top_by_trunk == Approx(to_tip).margin(1e-4));
                CHECK(limbs[leg].top_deviation == Approx(deviation).epsilon(1e-3));
                CHECK(limbs[leg].from_tip == legs.limbs[leg].from_tip);
            }
        }
    }
}

TEST_CASE("the trunk tells nothing of one leg, or of thighs that do not show") {
    const SkeletonTemplate& human = builtin_template("human21");
    const auto told = [&](const Legs<double>& legs) {
        int count = 0;
        for (const Limb<double>& limb : legs.anchored(human, 0.9)) count += limb.top_by_trunk.has_value();
        return count;
    };
    const Legs<double> whole(0.5);
    CHECK(told(whole) == 2);
    Legs<double> changed = whole;
    changed.limbs.pop_back();
    CHECK(told(changed) == 0);
    changed = whole;
    changed.limbs[0].line.flatness.setConstant(1);
    CHECK(told(changed) == 1); // the other one shows its thigh
    changed = whole;
    changed.limbs[0].from_tip[0] *= 1.5; // a leg that would be two thirds of the template's
    CHECK(told(changed) == 1);
}
