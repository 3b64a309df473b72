#include <cmath>
#include <limits>
#include <optional>

#include <skelgen/core/adjacency.hpp>
#include <skelgen/refinement/trunk_joints.hpp>

#include "catch.hpp"
#include "limb_shapes.hpp"

using namespace skelgen;
using namespace skelgen::core;
using namespace skelgen::refinement;
using namespace skelgen::test;

namespace {

using enum JointRole;

const int left_hip = joint_of(hip, Side::left), right_hip = joint_of(hip, Side::right);

/// A thigh of length 0.5 and a calf from `top` along `direction`, with the attachment so far from the hip.
template <typename Scalar>
Limb<Scalar> leg(Side side, const Vec3& top, const Vec3& direction, double attachment = 0.1, double thickness = 0.1) {
    auto limb =
        limb_along<Scalar>({top, top + direction}, {joint_of(hip, side), joint_of(knee, side)}, {1, 0.5}, thickness);
    limb.attachment = static_cast<Scalar>(attachment);
    return limb;
}

template <typename Scalar>
Placement<Scalar> with_legs(const SkeletonTemplate& human, Scalar scale, const std::vector<Limb<Scalar>>& legs) {
    Placement<Scalar> placement(human, scale);
    for (const Limb<Scalar>& limb : legs)
        for (std::size_t i = 0; i < limb.joints.size(); ++i)
            placement.put(limb.joints[i], point_on(limb, arc_of(limb, i)));
    return placement;
}

} // namespace

TEMPLATE_TEST_CASE("hips that are too wide are brought to their distance at rest, narrow ones are not widened", "",
                   float, double) {
    const TestType tolerance = 8 * std::numeric_limits<TestType>::epsilon();
    for (const double unit : {1.0, 100.0}) {
        const SkeletonTemplate human = scaled(builtin_template("human21"), unit);
        const double rest = 2 * 0.071 * 0.8; // rest-pose length to body length: 0.8
        for (const double apart : {2 * rest, 0.7 * rest}) {
            const std::vector legs{leg<TestType>(Side::left, Vec3(0.1 + apart / 2, 0.2, 0), -Vec3::UnitY()),
                                   leg<TestType>(Side::right, Vec3(0.1 - apart / 2, 0.2, 0), -Vec3::UnitY())};
            const auto placed = narrow_hips(with_legs(human, static_cast<TestType>(0.8 / unit), legs), legs);
            const double half = std::min(apart, rest) / 2;
            CHECK((placed.at(left_hip) - Vec3(0.1 + half, 0.2, 0).cast<TestType>()).norm() < tolerance);
            CHECK((placed.at(right_hip) - Vec3(0.1 - half, 0.2, 0).cast<TestType>()).norm() < tolerance);
        }
    }
}

TEST_CASE("hips whose thighs' lines have crossed before them go back to their thighs' sides") {
    const SkeletonTemplate& human = builtin_template("human21");
    // The thighs leave the trunk at y = -0.3, 0.2 apart in x, and their lines have met on the way up.
    const std::vector legs{
        leg<double>(Side::left, Vec3(-0.05, 0, 0), Vec3(0.5, -1, 0).normalized(), 0.3 * std::hypot(1, 0.5)),
        leg<double>(Side::right, Vec3(0.05, 0, 0), Vec3(-0.5, -1, 0).normalized(), 0.3 * std::hypot(1, 0.5))};
    const auto placed = narrow_hips(with_legs(human, 1.0, legs), legs);
    CHECK((placed.at(left_hip) - Vec3(0.071, 0, 0)).norm() < 1e-12);
    CHECK((placed.at(right_hip) - Vec3(-0.071, 0, 0)).norm() < 1e-12);
}

TEMPLATE_TEST_CASE("the trunk's joints lie between hips and neck as at rest, the waist in the centre of its section",
                   "", float, double) {
    // A tube along z from -0.15 to 2.15 around the axis; hips and neck 0.03 beside it.
    const Body<TestType> body = body_of<TestType>(capsule(0.15, 2, 32, 40));
    const Slicer<TestType> slicer(body.mesh, body.adjacency);
    const TestType tolerance = 64 * std::numeric_limits<TestType>::epsilon();
    for (const double unit : {1.0, 100.0}) {
        const SkeletonTemplate human = scaled(builtin_template("human21"), unit);
        for (const double degrees : {0.0, 90.0}) { // by which the thighs are raised
            const double angle = degrees * pi / 180;
            const Vec3 direction(0, std::sin(angle), -std::cos(angle));
            const std::vector legs{leg<TestType>(Side::left, Vec3(0.1, 0, 0.5), direction),
                                   leg<TestType>(Side::right, Vec3(-0.04, 0, 0.5), direction)};
            auto placement = with_legs(human, static_cast<TestType>(1 / unit), legs);
            placement.put(joint_of(neck), Vec3(0.03, 0, 1.5).cast<TestType>());
            const auto placed =
                place_trunk(std::move(placement), legs, slicer, Vector3<TestType>(Vector3<TestType>::Zero()),
                            std::optional<TrunkAxis<TestType>>(), {0.06});
            const auto at_rest = [](double height) { return (height - 0.87) / (1.492 - 0.87); };
            INFO("unit " << unit << ", flexed by " << degrees);
            CHECK((placed.at(joint_of(pelvis)) - Vec3(0.03, 0, 0.5 + at_rest(0.953)).cast<TestType>()).norm() <
                  tolerance);
            CHECK((placed.at(joint_of(chest)) - Vec3(0.03, 0, 0.5 + at_rest(1.274)).cast<TestType>()).norm() <
                  tolerance);
            const Vec3 waist_place(0, 0, 0.5 + at_rest(1.0566) - 0.06 * angle);
            CHECK((placed.at(joint_of(waist)) - waist_place.cast<TestType>()).norm() < tolerance);
            CHECK(placed.at(joint_of(neck)) == Vec3(0.03, 0, 1.5).cast<TestType>());
        }
    }
}

TEST_CASE("a waist's section is looked for within a part of the trunk's length, whatever the template's unit") {
    const Body<double> body = body_of<double>(capsule(0.05, 2, 32, 40));
    const Slicer<double> slicer(body.mesh, body.adjacency);
    for (const double unit : {0.01, 1.0, 100.0})
        for (const bool within : {true, false}) { // a trunk of length 1 beside a thin tube: 0.16 of it is in reach
            const SkeletonTemplate human = scaled(builtin_template("human21"), unit);
            const double x = within ? 0.095 : 0.3;
            const std::vector legs{leg<double>(Side::left, Vec3(x, 0.07, 0.5), -Vec3::UnitZ()),
                                   leg<double>(Side::right, Vec3(x, -0.07, 0.5), -Vec3::UnitZ())};
            auto placement = with_legs(human, 1 / unit, legs);
            placement.put(joint_of(neck), Vec3(x, 0, 1.5));
            const Vec3 found = place_trunk(placement, legs, slicer, Vec3(0, 0, 0)).at(joint_of(waist));
            CHECK(found.x() == Approx(x)); // its centre is farther off than it is thick: not the trunk's
        }
}

TEMPLATE_TEST_CASE("a waist whose section holds a thigh is on the trunk's axis, and a root that was placed stays", "",
                   float, double) {
    const Body<TestType> body = body_of<TestType>(capsule(0.15, 2, 32, 40));
    const Slicer<TestType> slicer(body.mesh, body.adjacency);
    const std::vector legs{leg<TestType>(Side::left, Vec3(0.1, 0, 0.5), -Vec3::UnitZ()),
                           leg<TestType>(Side::right, Vec3(-0.04, 0, 0.5), -Vec3::UnitZ())};
    auto placement = with_legs(builtin_template("human21"), TestType(1), legs);
    placement.put(joint_of(neck), Vec3(0.03, 0, 1.5).cast<TestType>());
    const Vector3<TestType> root = Vec3(0.01, 0.02, 0.6).cast<TestType>();
    placement.put(joint_of(pelvis), root);
    const auto placed_with = [&](const Vec3& up, double largest_section) {
        TrunkAxis<TestType> axis{Vec3(0.05, 0, 0.7).cast<TestType>(), up.normalized().cast<TestType>(),
                                 Vec3(0.05, 0, 0.55).cast<TestType>()};
        axis.largest_section = static_cast<TestType>(largest_section);
        const auto placed =
            place_trunk(placement, legs, slicer, Vector3<TestType>(Vector3<TestType>::Zero()), std::optional(axis));
        CHECK(placed.at(joint_of(pelvis)) == root);
        return Vec3(placed.at(joint_of(waist)).template cast<double>());
    };
    const double larger = 0.12, smaller = 0.05; // than the section, a disk of radius 0.15
    const Vec3 own = placed_with(Vec3::UnitZ(), larger), beside = placed_with(Vec3::UnitZ(), smaller);
    CHECK(std::abs(own.x()) < 1e-5);
    CHECK(beside.x() == Approx(0.05));
    CHECK(beside.z() == Approx(own.z()).epsilon(1e-5));
    double last = own.x();
    for (const double largest : {0.09, 0.085, 0.08, 0.075}) { // the more of it is a thigh's
        const double next = placed_with(Vec3::UnitZ(), largest).x();
        CHECK(next > last);
        CHECK(next < beside.x());
        last = next;
    }
    const Vec3 leaning = placed_with(Vec3(0.2, 0, 1), smaller);
    CHECK(leaning.x() == Approx(0.05 + 0.2 * (own.z() - 0.7)));
    CHECK(leaning.z() == Approx(own.z()).epsilon(1e-5));
    CHECK(placed_with(Vec3::UnitX(), smaller).x() == Approx(0.03)); // across: tells no height
}

TEST_CASE("without a neck the trunk ends between the shoulders, without these where the arms branch off") {
    SkeletonTemplate small{"small", {}};
    const auto add = [&](const char* name, int parent, JointRole role, Side side, const Vec3& place) {
        TemplateJoint joint;
        joint.name = name;
        joint.parent = parent;
        joint.role = role;
        joint.side = side;
        joint.position = place;
        small.joints.push_back(joint);
    };
    add("pelvis", -1, pelvis, Side::none, Vec3(0, 0, 0));
    add("waist", 0, waist, Side::none, Vec3(0, 0.25, 0));
    add("chest", 1, chest, Side::none, Vec3(0, 1, 0));
    add("left_hip", 0, hip, Side::left, Vec3(0.1, 0, 0));
    add("right_hip", 0, hip, Side::right, Vec3(-0.1, 0, 0));
    const SkeletonTemplate armless = small;
    add("left_shoulder", 2, shoulder, Side::left, Vec3(0.2, 1, 0));
    add("right_shoulder", 2, shoulder, Side::right, Vec3(-0.2, 1, 0));
    const Body<double> body = body_of<double>(capsule(0.15, 2, 32, 40));
    const Slicer<double> slicer(body.mesh, body.adjacency);
    Placement<double> placement(small, 1);
    placement.put(3, Vec3(0.1, 0.01, 0.4));
    placement.put(4, Vec3(-0.1, -0.01, 0.4));
    placement.put(5, Vec3(0.2, 0.02, 1.6));
    placement.put(6, Vec3(-0.2, -0.02, 1.6));
    const auto placed = place_trunk(placement, {}, slicer, Vec3(9, 9, 9));
    CHECK((placed.at(2) - Vec3(0, 0, 1.6)).norm() < 1e-12);
    CHECK((placed.at(0) - Vec3(0, 0, 0.4)).norm() < 1e-12);
    CHECK((placed.at(1) - Vec3(0, 0, 0.7)).norm() < 1e-12);

    Placement<double> without_shoulders(armless, 1);
    without_shoulders.put(3, Vec3(0.1, 0.01, 0.4));
    without_shoulders.put(4, Vec3(-0.1, -0.01, 0.4));
    const auto hung = place_trunk(without_shoulders, {}, slicer, Vec3(0, 0, 1.4));
    CHECK((hung.at(2) - Vec3(0, 0, 1.4)).norm() < 1e-12);
    CHECK((hung.at(1) - Vec3(0, 0, 0.65)).norm() < 1e-12);
}

TEMPLATE_TEST_CASE("a crotch too near to the surface rises towards the waist until it is deep enough", "", float,
                   double) {
    // A tube whose lowest vertex is at z = -0.15; the waist is 1 above the crotch, so that a step is 0.05.
    const Body<TestType> body = body_of<TestType>(capsule(0.15, 2, 32, 80));
    const SkeletonTemplate& human = builtin_template("human21");
    const auto crotch_from = [&](double height, double thickness) -> double {
        const std::vector legs{leg<TestType>(Side::left, Vec3(0.1, 0, 0), -Vec3::UnitZ(), 0.1, thickness)};
        auto placement = with_legs(human, TestType(1), legs);
        placement.put(joint_of(pelvis), Vec3(0, 0, height).cast<TestType>());
        placement.put(joint_of(waist), Vec3(0, 0, height + 1).cast<TestType>());
        const auto placed = raise_crotch(placement, legs, body.mesh);
        CHECK(placed.at(joint_of(pelvis)).template head<2>().norm() == 0);
        return static_cast<double>(placed.at(joint_of(pelvis)).z());
    };
    CHECK(crotch_from(0.5, 0.1) == Approx(0.5));              // deep enough: 0.15 against 0.75 * 0.1
    CHECK(crotch_from(-0.1, 0.1) == Approx(-0.05));           // at -0.1 it is 0.05 deep, a step higher 0.1
    CHECK(crotch_from(-0.1, 0.17) == Approx(0).margin(1e-6)); // 0.1275: two steps
    CHECK(crotch_from(-0.1, 0.3) == Approx(0.4));             // never deep enough: to the middle of the bone
    CHECK(crotch_from(-0.1, 0) == Approx(-0.1));              // nothing known of the thighs
}

TEST_CASE("options of the trunk's joints that make no sense are refused") {
    CHECK_NOTHROW(validate(TrunkOptions{}));
    CHECK_THROWS_AS(validate(TrunkOptions{10}), Error);
    CHECK_NOTHROW(validate(CrotchOptions{}));
    CHECK_THROWS_AS(validate(CrotchOptions{-1}), Error);
}
