#include <cmath>
#include <limits>

#include <skelgen/refinement/limb_joints.hpp>

#include "catch.hpp"
#include "limb_shapes.hpp"

using namespace skelgen;
using namespace skelgen::refinement;
using namespace skelgen::test;

namespace {

using enum JointRole;

std::vector<int> arm_joints() {
    return {joint_of(shoulder, Side::left), joint_of(elbow, Side::left), joint_of(wrist, Side::left),
            joint_of(hand, Side::left)};
}

std::vector<int> leg_joints() {
    return {joint_of(hip, Side::left), joint_of(knee, Side::left), joint_of(ankle, Side::left),
            joint_of(foot, Side::left)};
}

template <typename Scalar>
Placement<Scalar> nowhere() {
    return Placement<Scalar>(builtin_template("human21"), 1);
}

/// Twenty roundings of a length of about one.
template <typename Scalar>
Scalar tolerance() {
    return 20 * std::numeric_limits<Scalar>::epsilon();
}

/// An arm from the origin: an upper arm along x to 0.5, where it bends by `degrees` about z; the elbow's place by ratio
/// is 0.05 before the bend.
template <typename Scalar>
Limb<Scalar> bent_arm(double degrees) {
    const double angle = degrees * pi / 180;
    const Vec3 bend(0.5, 0, 0);
    return limb_along<Scalar>({Vec3::Zero(), bend, bend + Vec3(0.5 * std::cos(angle), 0.5 * std::sin(angle), 0)},
                              arm_joints(), {0.95, 0.55, 0.15, 0.05});
}

} // namespace

TEMPLATE_TEST_CASE("by ratio, joints lie on the centreline at their distances from the tip", "", float, double) {
    const auto limb = limb_along<TestType>({Vec3(0, 0, 1), Vec3(1, 0, 1)}, arm_joints(), {0.8, 0.5, 0.2, 0.1});
    const auto placement = place_by_ratio(nowhere<TestType>(), limb);
    const double expected[] = {0.2, 0.5, 0.8, 0.9};
    for (std::size_t i = 0; i < 4; ++i) {
        const Vector3<TestType> wanted = Vec3(expected[i], 0, 1).cast<TestType>();
        CHECK((placement.at(arm_joints()[i]) - wanted).norm() < tolerance<TestType>());
    }
    CHECK(placement.at(joint_of(neck)) == Vector3<TestType>::Zero());
}

TEMPLATE_TEST_CASE("a neck goes part of the way to its place below the throat", "", float, double) {
    const auto limb =
        limb_along<TestType>({Vec3::Zero(), Vec3(0, 0.3, 0)}, {joint_of(neck), joint_of(head)}, {0.25, 0.1});
    const auto by_ratio = place_by_ratio(nowhere<TestType>(), limb);
    HeadShape<TestType> shape;
    shape.up = Vector3<TestType>::UnitY();
    CHECK(place_neck(by_ratio, limb, shape).positions() == by_ratio.positions()); // no throat to be seen
    shape.throat = Vector3<TestType>(TestType(0.02), TestType(0.1), 0);
    const auto placed = place_neck(by_ratio, limb, shape, {0.2, 0.6});
    const double height = 0.05 + 0.6 * (0.1 - 0.2 * 0.25 - 0.05); // its own place, the throat's, 0.25 to the tip
    CHECK((placed.at(joint_of(neck)) - Vec3(0.6 * 0.02, height, 0).cast<TestType>()).norm() < tolerance<TestType>());
    CHECK(placed.at(joint_of(head)) == by_ratio.at(joint_of(head)));
    shape.throat->x() = TestType(0.06); // by a quarter of the height
    shape.forward = Vector3<TestType>::UnitX();
    const auto moved = [&](TestType frontness) -> Vector3<TestType> {
        shape.frontness = frontness;
        return place_neck(by_ratio, limb, shape, {0.2, 0.6}).at(joint_of(neck));
    };
    CHECK((moved(1) - Vec3(0, height, 0).cast<TestType>()).norm() < tolerance<TestType>()); // a chin
    CHECK((moved(-1) - Vec3(0.6 * 0.06, height, 0).cast<TestType>()).norm() < tolerance<TestType>());
    CHECK(moved(0) == moved(-1)); // a head that shows no front has no chin to either side
    shape.forward = -shape.forward;
    CHECK(moved(0) == moved(1));

    const auto arm = limb_along<TestType>({Vec3::Zero(), Vec3::UnitX()}, arm_joints(), {0.8, 0.5, 0.2, 0.1});
    CHECK(place_neck(nowhere<TestType>(), arm, shape).positions().isZero());
}

TEMPLATE_TEST_CASE("a wrist is where the arm is thinnest near its place, and no farther off", "", float, double) {
    auto limb = limb_along<TestType>({Vec3::Zero(), Vec3::UnitX()}, arm_joints(), {0.8, 0.5, 0.2, 0.1});
    const int joint = joint_of(wrist, Side::left);
    double stiffness = 0;
    const auto wrist_at = [&] {
        return place_wrist(place_by_ratio(nowhere<TestType>(), limb), limb, {0.1, stiffness}).at(joint).x();
    };
    limb.line.thickness[82] = TestType(0.04); // at x = 0.82, two hundredths from x = 0.8; the window is three
    CHECK(wrist_at() == Approx(0.82));
    limb.line.thickness[76] = TestType(0.03); // beyond the window
    CHECK(wrist_at() == Approx(0.82));
    limb.line.thickness[79] = TestType(0.035);
    CHECK(wrist_at() == Approx(0.79));
    limb.line.area[79] = limb.line.thickness[79] = 0; // no section there
    CHECK(wrist_at() == Approx(0.82));
    limb.line.thickness[83] = limb.line.thickness[82];
    CHECK(wrist_at() == Approx(0.825)); // between two that are equally thin
    stiffness = 1000;
    CHECK(wrist_at() == Approx(0.8).margin(0.005));

    auto leg = limb;
    leg.joints = leg_joints();
    CHECK(place_wrist(nowhere<TestType>(), leg).positions().isZero());
}

TEMPLATE_TEST_CASE("a straight elbow stays at its ratio, a bent one goes to where its bones' lines meet", "", float,
                   double) {
    const int joint = joint_of(elbow, Side::left);
    const auto elbow_of = [&](double degrees, const BendOptions& options) -> Vec3 {
        const auto limb = bent_arm<TestType>(degrees);
        return place_bend(place_by_ratio(nowhere<TestType>(), limb), limb, options).at(joint).template cast<double>();
    };
    const auto near = [](double x) { return Approx(x).margin(30 * std::numeric_limits<TestType>::epsilon()); };
    for (const double degrees : {0.0, 10.0, 24.0}) CHECK(elbow_of(degrees, {}).x() == near(0.45));
    for (const double degrees : {46.0, 90.0, 120.0}) {
        INFO("bent by " << degrees << " degrees");
        CHECK(elbow_of(degrees, {}).x() == near(0.45 + 0.7 * 0.05));
        CHECK(elbow_of(degrees, {25, 45, 1}).x() == near(0.5));
        CHECK(std::abs(elbow_of(degrees, {}).y()) < 1e-6);
    }
    CHECK(elbow_of(35, {}).x() == Approx(0.45 + 0.5 * 0.7 * 0.05).margin(2e-6));     // half way between: half as far
    CHECK(elbow_of(30, {}).x() == Approx(0.45 + 0.15625 * 0.7 * 0.05).margin(2e-6)); // t^2 (3 - 2 t) at a quarter
}

TEST_CASE("lines that meet far from the elbow are another joint's, and without bones there are no lines") {
    const int joint = joint_of(elbow, Side::left);
    auto limb = bent_arm<double>(90);
    const Vec3 far(0.45, 0, 0.26); // 0.3 of both bones' length of 0.8 is 0.24
    auto placement = place_by_ratio(nowhere<double>(), limb);
    placement.put(joint, far);
    CHECK(place_bend(placement, limb).at(joint) == far);
    placement.put(joint, Vec3(0.45, 0, 0.2));
    CHECK(place_bend(placement, limb).at(joint) != Vec3(0.45, 0, 0.2));
    limb.line.flatness.setConstant(0.2);
    placement.put(joint, Vec3(0.45, 0, 0.2));
    CHECK(place_bend(placement, limb).at(joint) == Vec3(0.45, 0, 0.2));
    CHECK(place_bend(placement, limb, {}, {0.3}).at(joint) != Vec3(0.45, 0, 0.2));
}

TEMPLATE_TEST_CASE("a hip prolongs the thigh's line, wherever the centreline goes in the trunk", "", float, double) {
    // In the trunk the centreline comes from the side; the thigh is along x from 0.
    auto limb =
        limb_along<TestType>({Vec3(0, 0, 0.4), Vec3::Zero(), Vec3::UnitX()}, leg_joints(), {1.2, 0.6, 0.2, 0.1});
    limb.attachment = TestType(0.45);
    const auto placed = place_girdle(place_by_ratio(nowhere<TestType>(), limb), limb);
    CHECK((placed.at(joint_of(hip, Side::left)) - Vec3(0.4 - 0.6, 0, 0).cast<TestType>()).norm() <
          tolerance<TestType>());
    CHECK((placed.at(joint_of(knee, Side::left)) - Vec3(0.4, 0, 0).cast<TestType>()).norm() < tolerance<TestType>());

    limb.line.flatness.setConstant(1); // no section of the thigh is its own: straight to where it leaves the trunk
    limb.attachment = TestType(0.2);
    const auto hidden = place_girdle(place_by_ratio(nowhere<TestType>(), limb), limb);
    const Vec3 knee_place(0.4, 0, 0), way = (Vec3(0, 0, 0.2) - knee_place).normalized();
    CHECK((hidden.at(joint_of(hip, Side::left)) - (knee_place + 0.6 * way).cast<TestType>()).norm() <
          tolerance<TestType>());
}

TEST_CASE("a shoulder that would be far from its distance to the neck goes where it keeps it best") {
    const SkeletonTemplate& human = builtin_template("human21");
    const int top = joint_of(shoulder, Side::left);
    const double rest = rest_length(human, top, joint_of(neck));
    // The upper arm's sections run along x, the centreline before them along z: two ways to go on from the elbow.
    auto limb = limb_along<double>({Vec3(0, 0, 0.3), Vec3::Zero(), Vec3::UnitX()}, arm_joints(), {1.1, 0.8, 0.3, 0.1});
    limb.attachment = 0.36;
    const Vec3 elbow_place(0.2, 0, 0), by_line(-0.1, 0, 0);
    const Vec3 by_start = elbow_place + 0.3 * (Vec3(0, 0, 0.1) - elbow_place).normalized(); // inner end: arc 0.2
    const auto shoulder_with_neck_at = [&](const Vec3& place) {
        auto placement = place_by_ratio(nowhere<double>(), limb);
        placement.put(joint_of(neck), place);
        return place_girdle(placement, limb).at(top);
    };
    REQUIRE((by_line - by_start).norm() > 0.1);
    CHECK((shoulder_with_neck_at(by_line + Vec3(0, rest, 0)) - by_line).norm() < 1e-12);
    CHECK((shoulder_with_neck_at(by_line + Vec3(0, 1.39 * rest, 0)) - by_line).norm() < 1e-12); // within the tolerance
    const Vec3 apart = (by_start - by_line).normalized(); // a neck that the arm's start is right for
    CHECK((shoulder_with_neck_at(by_start + rest * apart) - by_start).norm() < 1e-12);
}

TEMPLATE_TEST_CASE("a shoulder too far from the neck for a trunk that is longer than the limbs say comes nearer", "",
                   float, double) {
    using V = Vector3<TestType>;
    const SkeletonTemplate& human = builtin_template("human21");
    const int top = joint_of(shoulder, Side::left);
    const double rest_trunk = rest_length(human, joint_of(neck), 0), rest = rest_length(human, top, joint_of(neck));
    // An arm down along -y at half a shoulder's breadth from the neck, which is at the origin; its top `high` above it.
    const auto arm_at = [&](double aside, double high) {
        const Vec3 way(aside * rest, 0, 0);
        return limb_along<TestType>({way + Vec3(0, 3, 0), way - Vec3(0, 1, 0)}, arm_joints(),
                                    {1 + high, 0.7 + high, 0.4, 0.3});
    };
    const auto moved = [&](const Limb<TestType>& limb, double trunk) -> double {
        const auto before = place_by_ratio(Placement<TestType>(human, TestType(1)), limb);
        const V fork(0, static_cast<TestType>(-trunk * rest_trunk), 0);
        const auto after = place_shoulder_by_trunk(before, limb, fork);
        return static_cast<double>((after.at(top) - before.at(top)).y());
    };
    const double longer = 1.2, away = longer * rest, raised = 1.5 * away;
    const auto far = arm_at(0.5, raised);
    CHECK(moved(far, longer) == Approx(-std::sqrt(away * away - 0.25 * rest * rest) - raised).margin(1e-4));
    CHECK(moved(far, 0.99) == 0);                                              // a trunk no longer than the limbs say
    CHECK(moved(arm_at(0.5, 1.2 * away), longer) == 0);                        // as far as others are
    CHECK(moved(arm_at(1.8, raised), longer) == 0);                            // a line that no upper arm has
    CHECK(moved(arm_at(1.5, raised), longer) == Approx(-raised).margin(1e-4)); // at its nearest place
}

TEMPLATE_TEST_CASE("shoulders come nearer to the height at which people hold them, whichever way the body lies", "",
                   float, double) {
    using V = Vector3<TestType>;
    const SkeletonTemplate& human = builtin_template("human21");
    const int top = joint_of(shoulder, Side::left);
    auto limb = limb_along<TestType>({Vec3::Zero(), Vec3::UnitX()}, arm_joints(), {0.8, 0.5, 0.2, 0.1});
    limb.line.thickness.setConstant(1);
    const Eigen::Quaternion<TestType> turn(Eigen::AngleAxis<TestType>(TestType(0.7), V(1, 2, -1).normalized()));
    // A trunk of length 1 up to the neck at the origin, the head leant by so much, the shoulder so high, and the arm.
    const auto height = [&](double leant, double high, const Vec3& arm, double weight, bool turned) {
        Placement<TestType> before(human, TestType(1));
        const auto put = [&](int joint, const Vec3& place) {
            const V at = place.cast<TestType>();
            before.put(joint, turned ? V(turn * at) : at);
        };
        put(joint_of(head), Vec3(std::sin(leant), std::cos(leant), 0));
        for (const Side side : {Side::left, Side::right}) put(joint_of(hip, side), Vec3(0, -1, 0));
        put(top, Vec3(0.3, high, 0));
        put(joint_of(elbow, Side::left), Vec3(0.3, high, 0) + arm);
        const auto after = place_shoulder_by_height(before, limb, {0.4, weight});
        for (int j = 0; j < 21; ++j) CHECK((j == top || after.at(j) == before.at(j)));
        const V way = after.at(top);
        return static_cast<double>((turned ? V(turn.conjugate() * way) : way).y());
    };
    const Vec3 level = 0.5 * Vec3::UnitX(), hanging = -0.5 * Vec3::UnitY(), raised = 0.5 * Vec3::UnitY();
    const double usual = height(0, -0.1, level, 1, false);
    CHECK(usual < 0);
    CHECK(height(0, 0.1, level, 1, false) == Approx(usual).margin(1e-5)); // wherever it was
    CHECK(height(0, 0.1, level, 0.5, false) == Approx((0.1 + usual) / 2).margin(1e-5));
    CHECK(height(0, 0.1, level, 0, false) == Approx(0.1).margin(1e-5));
    CHECK(height(0, 0.1, level, 1, true) == Approx(usual).margin(1e-5));
    const double lower = height(0, -0.1, hanging, 1, false), higher = height(0, -0.1, raised, 1, false);
    CHECK(lower < usual - 0.05);
    CHECK(higher - usual == Approx(usual - lower).margin(1e-5));
    CHECK(height(0.3, -0.1, level, 1, false) < usual - 0.01); // beneath the head
    CHECK(height(-0.3, -0.1, level, 1, false) > usual + 0.01);

    // Farther off than anyone holds it: the arm's line is wrong, and turned about the elbow
    CHECK(height(0, usual - 0.19, level, 0, false) == Approx(usual - 0.19).margin(1e-5));
    CHECK(std::abs(height(0, usual - 0.3, level, 0, false) - usual) < 0.1);

    limb.line.thickness.setConstant(TestType(0.05)); // a stick: no section of it leans so far
    CHECK(height(0, 0.1, level, 1, false) == Approx(0.1).margin(1e-5));
    CHECK(height(0, usual + 0.04, level, 1, false) == Approx(usual).margin(1e-5));

    const auto leg = limb_along<TestType>({Vec3::Zero(), Vec3::UnitX()}, leg_joints(), {0.8, 0.5, 0.2, 0.1});
    Placement<TestType> standing(human, TestType(1));
    standing.put(joint_of(hip, Side::left), V(0, TestType(-1), 0));
    CHECK(place_shoulder_by_height(standing, leg).positions() == standing.positions());
}

TEST_CASE("limbs without shoulder or hip, or of one joint, are left as they are") {
    const auto neck_and_head =
        limb_along<double>({Vec3::Zero(), Vec3::UnitY()}, {joint_of(neck), joint_of(head)}, {0.5, 0.2});
    CHECK(place_girdle(nowhere<double>(), neck_and_head).positions().isZero());
    const auto only_head = limb_along<double>({Vec3::Zero(), Vec3::UnitY()}, {joint_of(head)}, {0.2});
    CHECK(place_girdle(nowhere<double>(), only_head).positions().isZero());
    CHECK(place_bend(nowhere<double>(), only_head).positions().isZero());
}

TEST_CASE("options of the limbs' joints that make no sense are refused") {
    CHECK_NOTHROW(validate(BendOptions{}));
    CHECK_THROWS_AS(validate(BendOptions{45, 45, 0.7}), Error); // nothing to blend over
    CHECK_THROWS_AS(validate(BendOptions{-1, 45, 0.7}), Error);
    CHECK_NOTHROW(validate(NeckOptions{}));
    CHECK_THROWS_AS(validate(NeckOptions{0.07, 1.5}), Error);
    CHECK_THROWS_AS(validate(NeckOptions{0.07, 0.6, -1}), Error);
    CHECK_NOTHROW(validate(WristOptions{}));
    CHECK_THROWS_AS(validate(WristOptions{-0.1}), Error);
    CHECK_THROWS_AS(validate(WristOptions{0.1, -1}), Error);
    CHECK_NOTHROW(validate(GirdleOptions{}));
    CHECK_THROWS_AS(validate(GirdleOptions{0.4, 1.1}), Error);
    CHECK_THROWS_AS(validate(GirdleOptions{0.4, 0.5, -1}), Error);
    CHECK_NOTHROW(validate(GirdleOptions{}));
    CHECK_THROWS_AS(validate(GirdleOptions{std::nan("")}), Error);
    CHECK_THROWS_AS(validate(BoneLineOptions{-0.1}), Error);
}
