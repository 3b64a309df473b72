#include <cmath>

#include <skelgen/core/builtin_templates.hpp>
#include <skelgen/embedding/reduced_graph.hpp>
#include <skelgen/refinement/limbs.hpp>

#include "catch.hpp"
#include "limb_shapes.hpp"

using namespace skelgen;
using namespace skelgen::refinement;
using namespace skelgen::test;
using skelgen::embedding::longest_path;

TEST_CASE("a body twice as large has twice the scale, a template twice as large half of it") {
    const SkeletonTemplate& human = builtin_template("human21");
    const SkeletonTemplate large = scaled(human, 2);
    const double scale = template_scale(human, 2.0);
    CHECK(scale > 0);
    CHECK(template_scale(human, 4.0) == Approx(2 * scale));
    CHECK(template_scale(large, 2.0) == Approx(scale / 2));
}

TEST_CASE("over the surface it is a little shorter from toe to fingertip than along the bones") {
    for (const char* name : {"human21", "pinocchio18"}) {
        const SkeletonTemplate& human = builtin_template(name);
        const double scale = template_scale(human, longest_path(human));
        CHECK(scale >= 1);
        CHECK(scale < 1.2);
    }
}

TEMPLATE_TEST_CASE("an arm's joints lie on the axis of a straight tube, at the template's distances from its tip", "",
                   float, double) {
    constexpr double radius = 0.05, tip = 2 + radius;
    const Body<TestType> body = body_of<TestType>(capsule(radius, 2, 32, 100));
    const Slicer<TestType> slicer(body.mesh, body.adjacency);
    const int hand = joint_of(JointRole::hand, Side::left);
    const std::vector ends{end_point_near(body, Vec3(0, 0, tip), hand)};
    for (const double unit : {1.0, 100.0}) {
        const SkeletonTemplate human = scaled(builtin_template("human21"), unit);
        const auto limbs = trace_limbs(slicer, ends, human, static_cast<TestType>(1.2 / unit));
        REQUIRE(limbs.size() == 1);
        const Limb<TestType>& arm = limbs[0];
        CHECK(arm.joints == std::vector<int>{joint_of(JointRole::shoulder, Side::left),
                                             joint_of(JointRole::elbow, Side::left),
                                             joint_of(JointRole::wrist, Side::left), hand});
        const double from_tip[] = {0.897 - 0.185, 0.897 - 0.453, 0.897 - 0.705, 0.897 - 0.794};
        REQUIRE(arm.from_tip.size() == 4);
        for (std::size_t i = 0; i < 4; ++i) {
            CHECK(arm.from_tip[i] == Approx(1.2 * from_tip[i]).epsilon(1e-6));
            const Vector3<TestType> place = point_on(arm, arc_of(arm, i));
            CHECK(place.template head<2>().norm() < 1e-3 * radius);
            CHECK(place.z() == Approx(tip - 1.2 * from_tip[i]).margin(1e-3));
        }
        CHECK((tip_of(arm) - Vec3(0, 0, tip).cast<TestType>()).norm() < 1e-6);
        // Rings are drawn a twentieth beyond the shoulder, geodesic length; over the tube's end that is longer than
        // along the axis by a quarter of a circle less the radius.
        const double drawn = 1.05 * 1.2 * from_tip[0] - (pi / 2 - 1) * radius;
        CHECK(arm.line.arc[arm.line.arc.size() - 1] == Approx(drawn).margin(2 * 0.0125));
        CHECK(arm.attachment == 0); // it is its own all along
        CHECK_FALSE(arm.top_by_trunk.has_value());
        CHECK(find_in_limb(arm, human, JointRole::wrist) == 2);
        CHECK_FALSE(find_in_limb(arm, human, JointRole::knee));
    }
}

TEST_CASE("a limb shortened is the outer part of its line, as long as it would be drawn, and twice is once") {
    const Body<double> body = body_of<double>(capsule(0.05, 2, 32, 100));
    const Slicer<double> slicer(body.mesh, body.adjacency);
    Limb<double> arm;
    arm.joints = {joint_of(JointRole::shoulder, Side::left), joint_of(JointRole::elbow, Side::left),
                  joint_of(JointRole::hand, Side::left)};
    arm.from_tip = {1.2, 0.7, 0.1};
    const EndPoint<double> end = end_point_near(body, Vec3(0, 0, 2.05), arm.joints[2]);
    arm = draw_limb(arm, slicer, end);
    Limb<double> nearer = arm;
    nearer.from_tip = {0.8, 0.5, 0.1};
    const Limb<double> drawn = draw_limb(nearer, slicer, end), shorter = shorten_line(nearer);
    const auto length = [](const Limb<double>& limb) { return limb.line.arc[limb.line.arc.size() - 1]; };
    CHECK(length(shorter) < 0.75 * length(arm));
    CHECK(length(shorter) == Approx(length(drawn)).margin(3 * CentrelineOptions{}.step));
    CHECK(tip_of(shorter) == tip_of(arm));
    for (std::size_t i = 0; i < 3; ++i) {
        const double z = 2.05 - nearer.from_tip[i];
        CHECK((point_on(shorter, arc_of(shorter, i)) - Vec3(0, 0, z)).norm() < 1e-3);
    }
    const Limb<double> again = shorten_line(shorter);
    CHECK(again.line.points == shorter.line.points);
}

TEMPLATE_TEST_CASE("a limb of a Y stays in its own tube up to the fork", "", float, double) {
    const Body<TestType> body = body_of<TestType>(three_tubes());
    const Slicer<TestType> slicer(body.mesh, body.adjacency);
    for (const Vec3& end : three_tube_ends()) {
        Limb<TestType> limb;
        limb.joints = {joint_of(JointRole::elbow, Side::left), joint_of(JointRole::hand, Side::left)};
        limb.from_tip = {TestType(0.7), TestType(0.1)};
        limb = draw_limb(limb, slicer, end_point_near(body, Vec3(1.12 * end), limb.joints[1]));
        for (Eigen::Index i = 3; i + 3 < limb.line.points.rows(); ++i) {
            INFO("arc length " << limb.line.arc[i]);
            const Vec3 p = limb.line.points.row(i).transpose().template cast<double>();
            if (p.norm() < 0.3 || limb.line.arc[limb.line.arc.size() - 1] - limb.line.arc[i] < 0.12) continue;
            CHECK(segment_distance(p, Vec3::Zero(), end) < 0.02);
            CHECK(limb.line.thickness[i] == Approx(0.12).epsilon(0.05));
        }
    }
}

TEST_CASE("a limb is attached where it runs into what is much thicker than itself") {
    // A rod of radius 0.05 from z = 0 to 1 on a drum of radius 0.2.
    const Mesh mesh = surface_of_revolution(
        {{0, -0.5},   {0.1, -0.5}, {0.2, -0.5}, {0.2, -0.4}, {0.2, -0.3}, {0.2, -0.2}, {0.2, -0.1}, {0.2, 0},
         {0.12, 0},   {0.05, 0},   {0.05, 0.1}, {0.05, 0.2}, {0.05, 0.3}, {0.05, 0.4}, {0.05, 0.5}, {0.05, 0.6},
         {0.05, 0.7}, {0.05, 0.8}, {0.05, 0.9}, {0.05, 1},   {0.025, 1},  {0, 1}},
        32);
    const Body<double> body = body_of<double>(mesh);
    const Slicer<double> slicer(body.mesh, body.adjacency);
    Limb<double> limb;
    limb.joints = {joint_of(JointRole::shoulder, Side::left), joint_of(JointRole::elbow, Side::left)};
    limb.from_tip = {1.2, 0.5};
    limb = draw_limb(limb, slicer, end_point_near(body, Vec3(0, 0, 1)));
    CHECK(point_on(limb, limb.attachment).z() == Approx(0).margin(2 * 0.0125));
    CHECK(point_on(limb, limb.attachment).head<2>().norm() < 1e-3);
}
