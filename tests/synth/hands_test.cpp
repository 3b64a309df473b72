#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include <skelgen/core/error.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/synth/sets.hpp>

#include "catch.hpp"
#include "synth/surface_mesher.hpp"

using namespace skelgen;
using namespace skelgen::synth;
using hands::Digit;

namespace {

/// A body in the A-pose with that left hand, a usual right one, and few faces elsewhere.
BodyPlan with_left_hand(const HandShape& hand) {
    BodyPlan plan;
    plan.pose = named_pose("a");
    plan.faces = 14000;
    plan.hands[0] = hand;
    return plan;
}

std::vector<DigitTruth> digits_on(const SynthBody& body, Side side) {
    std::vector<DigitTruth> out;
    for (const DigitTruth& digit : body.truth.digits)
        if (digit.side == side) out.push_back(digit);
    return out;
}

double distance_to_vertices(const TriangleMesh<double>& mesh, const Vector3<double>& p) {
    return (mesh.vertices.rowwise() - p.transpose()).rowwise().norm().minCoeff();
}

double bend(const DigitTruth& digit) {
    const Vector3<double> first = digit.joints[1] - digit.joints[0], last = digit.tip - digit.joints[2];
    return std::atan2(first.cross(last).norm(), first.dot(last));
}

} // namespace

TEST_CASE("the joints of five digits lie in the body, and end on its surface") {
    const SynthBody body = synthesize_body(with_left_hand({}));
    REQUIRE(body.truth.digits.size() == 10);
    for (const DigitTruth& digit : body.truth.digits) {
        INFO(hands::joint_name(digit.side, digit.digit, 1));
        CHECK_FALSE(digit.is_fused);
        for (const auto& joint : digit.joints) CHECK(core::winding_number<double>(body.mesh, joint) > 0.5);
        CHECK(distance_to_vertices(body.mesh, digit.tip) < 0.006);
        if (digit.digit != Digit::thumb) CHECK((digit.joints[0] - body.truth.joints[8]).norm() > 0);
    }
    const auto left = digits_on(body, Side::left), right = digits_on(body, Side::right);
    REQUIRE(left.size() == 5);
    for (std::size_t d = 0; d < left.size(); ++d) {
        CHECK(left[d].digit == hands::all_digits[d]);
        const Vector3<double> mirrored = right[d].joints[2].cwiseProduct(Vector3<double>(-1, 1, 1));
        CHECK((left[d].joints[2] - mirrored).norm() < 1e-9);
    }
}

TEST_CASE("hands have as many digits as are asked for, and bend as they are asked to") {
    for (const int digits : {2, 4}) {
        HandShape few;
        few.digits = digits;
        for (DigitShape& digit : few.digit) digit.curl = 30;
        few.digit[0] = {10, 10, false};
        const SynthBody body = synthesize_body(with_left_hand(few));
        CHECK(topology_of(body.mesh).components == 1);
        const auto left = digits_on(body, Side::left), right = digits_on(body, Side::right);
        REQUIRE(left.size() == static_cast<std::size_t>(digits));
        CHECK(right.size() == 5);
        CHECK(bend(left[1]) > bend(right[1]) + 0.8); // 30 degrees at each of two joints
        CHECK(bend(left[0]) > bend(right[0]) + 0.2);
    }
}

TEST_CASE("digits that have grown together, and those of a fist, are said to be one") {
    HandShape pair, mitten, fist;
    pair.digit[2].joined = true;
    for (const std::size_t i : {1U, 2U, 3U}) mitten.digit[i].joined = true;
    for (DigitShape& digit : fist.digit) digit.curl = 90;
    fist.digit[0].curl = 30;
    SynthBody body;
    const auto fused = [&](const HandShape& hand) {
        BodyPlan plan = with_left_hand(hand);
        plan.may_touch = true;
        body = synthesize_body(plan);
        std::vector<Digit> out;
        for (const DigitTruth& digit : digits_on(body, Side::left))
            if (digit.is_fused) out.push_back(digit.digit);
        return out;
    };
    CHECK(fused(mitten) == std::vector{Digit::middle, Digit::ring, Digit::little});
    const std::vector<Digit> in_fist = fused(fist);
    for (const Digit digit : {Digit::middle, Digit::ring, Digit::little})
        CHECK(std::find(in_fist.begin(), in_fist.end(), digit) != in_fist.end());

    CHECK(fused(pair) == std::vector{Digit::ring});
    const auto json = nlohmann::json::parse(truth_to_json(body.truth, "x.off"));
    CHECK(json["fused"] == nlohmann::json{{"left_middle_1", {"ring"}}});
    CHECK(json["fingers"].size() == 30);
    CHECK(json["end_points"].contains("right_little_tip"));
}

TEST_CASE("a glove is thicker than its hand, around the same joints") {
    HandShape glove;
    for (DigitShape& digit : glove.digit) digit.spread = 6;
    const SynthBody bare = synthesize_body(with_left_hand(glove));
    glove.glove = 0.004;
    const SynthBody gloved = synthesize_body(with_left_hand(glove));
    const auto a = digits_on(bare, Side::left), b = digits_on(gloved, Side::left);
    for (std::size_t d = 0; d < a.size(); ++d) {
        CHECK_FALSE(b[d].is_fused);
        CHECK((a[d].joints[0] - a[d].joints[2]).norm() == Approx((b[d].joints[0] - b[d].joints[2]).norm()));
        CHECK((b[d].tip - b[d].joints[2]).norm() == Approx((a[d].tip - a[d].joints[2]).norm() + 0.004));
    }
}

TEST_CASE("what a hand holds is a piece of its own between its fingers") {
    HandShape holding;
    for (DigitShape& digit : holding.digit) digit.curl = 50;
    holding.digit[0] = {10, 10, false};
    for (const HeldThing thing : {HeldThing::staff, HeldThing::ball}) {
        holding.holds = thing;
        const SynthBody body = synthesize_body(with_left_hand(holding));
        CHECK(topology_of(body.mesh).components == 2);
        for (const DigitTruth& digit : digits_on(body, Side::left)) CHECK_FALSE(digit.is_fused);
    }
    BodyPlan without = with_left_hand(holding);
    without.missing = {BodyJoint::left_wrist};
    const SynthBody body = synthesize_body(without);
    CHECK(topology_of(body.mesh).components == 1);
    CHECK(digits_on(body, Side::left).empty());
    CHECK(digits_on(body, Side::right).size() == 5);
}

TEST_CASE("what just touches itself is refused with the cause, and not meshed for ever", "[slow]") {
    const auto refusal = [](const auto& shape, double reach, bool one_body) {
        const auto two = [&](const Vec3& p) {
            return std::min(shape(p + reach * Vec3(1, 1, 0)), shape(p - reach * Vec3(1, 1, 0)));
        };
        try {
            (void)mesh_surface({two, [](const Vec3&) { return 1.0; }, -reach * Vec3(1, 1, 0), 2.5}, 1000, one_body);
        } catch (const Error& error) {
            CHECK(error.code() == ErrorCode::internal);
            return std::string(error.what());
        }
        return std::string();
    };
    const auto box = [](const Vec3& p) {
        const Vec3 beyond = p.cwiseAbs() - Vec3::Constant(0.5);
        return beyond.cwiseMax(0.0).norm() + std::min(beyond.maxCoeff(), 0.0);
    };
    const auto ball = [](const Vec3& p) { return p.norm() - 0.5; };
    CHECK(refusal(box, 0.5, false).find("just touches itself") != std::string::npos); // they have an edge in common
    CHECK(refusal(ball, 0.5, false).empty());
    CHECK(refusal(ball, 0.5, true).find("2 piece(s), and 0 handle(s)") != std::string::npos);
}

TEST_CASE("hands out of their range are refused") {
    const auto refusal = [](const auto& change) {
        HandShape hand;
        change(hand);
        try {
            check_hand(hand);
        } catch (const Error& error) {
            CHECK(error.code() == ErrorCode::usage);
            return std::string(error.what());
        }
        return std::string();
    };
    CHECK(refusal([](HandShape& h) { h.digits = 6; }).find("2 to 5") != std::string::npos);
    CHECK(refusal([](HandShape& h) { h.glove = 0.1; }).find("0 to 0.006 m") != std::string::npos);
    CHECK(refusal([](HandShape& h) { h.digit[1].curl = 120; }).find("-10 to 90 degrees") != std::string::npos);
    CHECK(refusal([](HandShape& h) { h.digit[4].spread = 40; }).find("-5 to 15 degrees") != std::string::npos);
    CHECK(refusal([](HandShape&) {}).empty());
}

TEST_CASE("the hands of the set are drawn by themselves, of all kinds") {
    const auto plans = body_set("hands", 1), again = body_set("hands", 1);
    REQUIRE(plans.size() == 24);
    std::size_t few = 0, joined = 0, gloved = 0, holding = 0, missing = 0, differ = 0;
    for (std::size_t i = 0; i < plans.size(); ++i) {
        for (const HandShape& hand : plans[i].hands) {
            few += hand.digits < 5;
            gloved += hand.glove > 0;
            holding += hand.holds != HeldThing::none;
            joined += std::any_of(hand.digit.begin(), hand.digit.end(), [](const auto& d) { return d.joined; });
        }
        missing += plans[i].missing.size();
        differ += plans[i].hands[0].digit[1].curl != plans[i].hands[1].digit[1].curl;
        CHECK(plans[i].hands[1].digit[2].curl == again[i].hands[1].digit[2].curl);
    }
    for (const std::size_t kind : {few, joined, gloved, holding, missing}) CHECK(kind > 0);
    CHECK(differ == plans.size());
}
