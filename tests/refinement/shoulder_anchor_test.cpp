#include <cmath>
#include <optional>

#include <skelgen/refinement/impl/shoulder_anchor.hpp>

#include "catch.hpp"
#include "limb_shapes.hpp"

using namespace skelgen;
using namespace skelgen::refinement;
using namespace skelgen::test;

namespace {

using enum JointRole;

constexpr double elbow_from_tip = 0.6, shoulder_from_tip = 1.0, armpit_from_tip = 0.85;

/// An arm along `outwards`, 0.05 thick up to where the armpit begins, and towards the trunk thicker by the same in each
/// length: 15 % after `growth`.
template <typename Scalar>
Limb<Scalar> arm(const Vec3& outwards, double growth = 0.03) {
    auto limb = limb_along<Scalar>({Vec3::Zero(), 1.2 * outwards},
                                   {joint_of(shoulder, Side::left), joint_of(elbow, Side::left),
                                    joint_of(wrist, Side::left), joint_of(hand, Side::left)},
                                   {shoulder_from_tip, elbow_from_tip, 0.2, 0.1});
    for (Eigen::Index i = 0; i < limb.line.arc.size(); ++i) {
        const double beyond = 1.2 - static_cast<double>(limb.line.arc[i]) - armpit_from_tip;
        if (beyond > 0) limb.line.thickness[i] *= static_cast<Scalar>(1 + 0.15 * beyond / growth);
    }
    return limb;
}

} // namespace

TEMPLATE_TEST_CASE("a shoulder lies a third of the upper arm beyond where this begins to grow", "", float, double) {
    const SkeletonTemplate& human = builtin_template("human21");
    const double upper = shoulder_from_tip - elbow_from_tip;
    for (const double degrees : {-90.0, -30.0, 0.0, 60.0}) {
        const double raised = std::sin(degrees * pi / 180);
        const Vec3 outwards(std::cos(degrees * pi / 180), 0, raised);
        const auto limbs = anchor_shoulders<TestType>({arm<TestType>(outwards)}, Vector3<TestType>::UnitZ(), human);
        REQUIRE(limbs[0].top_by_trunk.has_value());
        const double expected = armpit_from_tip + 0.03 + (0.33 - 0.05 * raised) * upper;
        CHECK(*limbs[0].top_by_trunk == Approx(expected).margin(1e-4));
        CHECK(limbs[0].top_deviation == Approx(0.09 * upper));
        CHECK(limbs[0].from_tip == arm<TestType>(outwards).from_tip);
        const auto anyhow = anchor_shoulders<TestType>({arm<TestType>(outwards)}, std::nullopt, human);
        CHECK(*anyhow[0].top_by_trunk == Approx(armpit_from_tip + 0.03 + 0.33 * upper).margin(1e-4));
    }
}

TEST_CASE("an arm that does not grow, or shows nothing of its own, says nothing of its shoulder, nor does a leg") {
    const SkeletonTemplate& human = builtin_template("human21");
    const auto tells = [&](const Limb<double>& limb) {
        return anchor_shoulders<double>({limb}, std::nullopt, human)[0].top_by_trunk.has_value();
    };
    const Limb<double> plain = arm<double>(Vec3::UnitX());
    REQUIRE(tells(plain));
    Limb<double> changed = plain;
    changed.line.thickness.setConstant(0.05);
    CHECK_FALSE(tells(changed));
    changed = plain;
    for (Eigen::Index i = 0; i < changed.line.arc.size(); ++i)
        if (changed.line.arc[i] > 1.2 - armpit_from_tip && changed.line.arc[i] < 1.2 - elbow_from_tip)
            changed.line.thickness[i] = 0; // no section of the upper arm was found
    CHECK_FALSE(tells(changed));
    changed = plain;
    changed.joints = {joint_of(hip, Side::left), joint_of(knee, Side::left), joint_of(ankle, Side::left),
                      joint_of(foot, Side::left)};
    CHECK_FALSE(tells(changed));
}
