#include <skelgen/hands/find_hands.hpp>

#include <array>
#include <string>
#include <vector>

#include <skelgen/surface/prepare.hpp>

#include "anatomy/rest_skeleton.hpp"
#include "catch.hpp"
#include "foot_shape.hpp"
#include "hand_shape.hpp"

using namespace skelgen;
using namespace skelgen::test;
using hands::DigitKind;

namespace {

hands::Hand<double> only_foot(const Mesh& mesh, const KinematicSkeleton<double>& skeleton) {
    const auto found = hands::find_feet(mesh, surface::prepare(mesh), skeleton);
    REQUIRE(found.size() == 1);
    CHECK(found.front().kind == DigitKind::toe);
    return found.front();
}

} // namespace

TEST_CASE("five toes of a foot are found, from the big one on, and have two joints each", "[hands]") {
    const std::vector<Toe> toes = five_toes();
    const hands::Hand<double> foot = only_foot(foot_of(toes), leg_skeleton());
    REQUIRE(foot.digits.size() == 5);
    for (std::size_t t = 0; t < toes.size(); ++t) {
        INFO(hands::name_of(hands::all_digits[t], DigitKind::toe));
        const hands::FoundDigit<double>& toe = foot.digits[t];
        CHECK(toe.digit == hands::all_digits[t]);
        CHECK(toe.fused.empty());
        CHECK((toe.tip - toes[t].tip()).norm() < 0.06);
        const Vec3 bone = toes[t].end - toes[t].base;
        CHECK(segment_distance(toe.joints[0], toes[t].base - bone, toes[t].end) < 0.15);
        CHECK(segment_distance(toe.joints[1], toes[t].base, toes[t].end) < 0.07);
        const double along = (toe.joints[1] - toe.joints[0]).dot(bone) / bone.squaredNorm();
        CHECK(along > 0.2);
        CHECK(along < 0.6);
        CHECK(toe.hinge.z() == Approx(0).margin(0.2));
        CHECK((toe.tip - toe.joints[1]).normalized().cross(toe.hinge).z() > 0.5); // positive turns: towards the sole
        CHECK(toe.confidence > 0.5);
    }
}

TEST_CASE("the big toe is on the inner side of the right foot, too", "[hands]") {
    KinematicSkeleton<double> skeleton = leg_skeleton();
    for (Joint<double>& joint : skeleton.joints) {
        joint.name.replace(0, 4, "right");
        joint.position.x() *= -1;
    }
    skeleton.end_points = {{"right_toe", Vec3(-0.34, 1, -0.02)}};
    const hands::Hand<double> foot = only_foot(mirrored(foot_of(five_toes())), skeleton);
    REQUIRE(foot.digits.size() == 5);
    CHECK(foot.side == Side::right);
    CHECK((foot.digits[0].tip - five_toes()[0].tip().cwiseProduct(Vec3(-1, 1, 1))).norm() < 0.06);
}

TEST_CASE("shoes and feet without gaps show no toes", "[hands]") {
    CHECK(only_foot(foot_of({}, true), leg_skeleton()).digits.empty());
    CHECK(only_foot(foot_of(five_toes(), true), leg_skeleton()).digits.size() < 2);
    std::vector<Toe> thick = five_toes();
    for (Toe& toe : thick) toe.radius = 0.2;
    CHECK(only_foot(foot_of(thick), leg_skeleton()).digits.size() < 5);
}

TEST_CASE("a skeleton gets the joints of all toes below the foot's, and loses them again", "[hands]") {
    const KinematicSkeleton<double> skeleton = leg_skeleton();
    std::vector<Toe> some = five_toes();
    some.resize(2);
    const auto feet = std::vector{only_foot(foot_of(some), skeleton)};
    const KinematicSkeleton<double> all = hands::with_toes(skeleton, feet);
    CHECK(all.template_name == "human21");
    REQUIRE(all.joints.size() == skeleton.joints.size() + 10);
    const auto joint = [&](const std::string& name) { return joint_named(all, name); };
    CHECK(joint("left_toe1_1").is_present);
    CHECK(all.joints.at(static_cast<std::size_t>(joint("left_toe1_1").parent)).name == "left_foot");
    CHECK(all.joints.at(static_cast<std::size_t>(joint("left_toe1_2").parent)).name == "left_toe1_1");
    CHECK_FALSE(joint("left_toe5_2").is_present);
    CHECK(all.end_points.back().first == "left_toe2_tip");
    const KinematicSkeleton<double> again = hands::without_digits(all);
    CHECK(again.joints.size() == skeleton.joints.size());
    CHECK(again.end_points.size() == 1);
}
