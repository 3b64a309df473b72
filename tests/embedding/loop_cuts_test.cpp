#include <algorithm>
#include <array>

#include <skelgen/core/builtin_templates.hpp>
#include <skelgen/core/error.hpp>
#include <skelgen/embedding/loop_cuts.hpp>

#include "catch.hpp"
#include "embedding/human_curve.hpp"

using namespace skelgen;
using namespace skelgen::embedding;
using namespace skelgen::test;

namespace {

const SkeletonTemplate& human() { return builtin_template("human21"); }

int joint(const std::string& name) {
    const auto& joints = human().joints;
    const auto found = std::find_if(joints.begin(), joints.end(), [&](const auto& j) { return j.name == name; });
    REQUIRE(found != joints.end());
    return static_cast<int>(found - joints.begin());
}

/// The node of human_curve() at this place.
int node_at(const CurveSkeleton<double>& curve, const Vector3<double>& p) {
    Eigen::Index node = 0;
    REQUIRE((curve.nodes.rowwise() - p.transpose()).rowwise().norm().minCoeff(&node) < 1e-12);
    return static_cast<int>(node);
}

int tip(const CurveSkeleton<double>& curve, const std::string& name) {
    return node_at(curve, *human().joints[static_cast<std::size_t>(joint(name))].tip);
}

int middle_of_bone(const CurveSkeleton<double>& curve, const std::string& a, const std::string& b) {
    return node_at(curve, 0.5 * (human().joints[static_cast<std::size_t>(joint(a))].position +
                                 human().joints[static_cast<std::size_t>(joint(b))].position));
}

LoopCuts best_cuts(const CurveSkeleton<double>& curve) {
    const std::vector<LoopCuts> ways = find_loop_cuts(curve, human());
    return ways.empty() ? LoopCuts{} : ways.front();
}

bool contains(const std::vector<int>& nodes, int node) {
    return std::find(nodes.begin(), nodes.end(), node) != nodes.end();
}

} // namespace

TEST_CASE("a tree has no loop to cut") { CHECK(find_loop_cuts(human_curve(), human()).empty()); }

TEST_CASE("a small loop from a junction back to itself is no contact, a limb's loop is") {
    CurveSkeleton<double> curve = human_curve();
    CHECK(contact_count(curve) == 0);
    const int hip = middle_of_bone(curve, "left_hip", "left_knee");
    const auto first = static_cast<int>(curve.nodes.rows());
    const Vector3<double> place = curve.nodes.row(hip);
    curve.nodes.conservativeResize(first + 2, 3);
    curve.nodes.row(first) = (place + Vector3<double>(0.05, 0.05, 0)).transpose();
    curve.nodes.row(first + 1) = (place + Vector3<double>(0.05, -0.05, 0)).transpose();
    curve.radii.resize(curve.radii.size() + 2, 0.02);
    curve.regions.resize(curve.regions.size() + 2);
    for (const auto& edge : {std::array{hip, first}, std::array{first, first + 1}, std::array{hip, first + 1}})
        curve.edges.push_back(edge);
    CHECK(contact_count(curve) == 0);
    CHECK(find_loop_cuts(curve, human()).empty());

    const int hand = tip(curve, "right_hand"), thigh = middle_of_bone(curve, "right_hip", "right_knee");
    curve.edges.push_back({std::min(hand, thigh), std::max(hand, thigh)});
    CHECK(contact_count(curve) == 1);
    const LoopCuts cuts = best_cuts(curve);
    REQUIRE(cuts.size() == 1);
    CHECK(cuts[0].limb.front() == hand);
}

TEST_CASE("clasped hands are cut between the hands") {
    CurveSkeleton<double> curve = human_curve();
    const int left = tip(curve, "left_hand"), right = tip(curve, "right_hand");
    curve.nodes.row(left) << 0.02, 1.2, -0.25;
    curve.nodes.row(right) << -0.02, 1.2, -0.25;
    for (const std::string side : {"left", "right"}) {
        const std::array<std::string, 4> arm{side + "_shoulder", side + "_elbow", side + "_wrist", side + "_hand"};
        std::array<int, 3> middles{};
        for (std::size_t k = 0; k < middles.size(); ++k) middles[k] = middle_of_bone(curve, arm[k], arm[k + 1]);
        const double sign = side == "left" ? 1 : -1;
        curve.nodes.row(joint(arm[1])) << sign * 0.3, 1.19, -0.05; // an arm is as long as it is
        curve.nodes.row(joint(arm[2])) << sign * 0.16, 1.2, -0.25;
        curve.nodes.row(joint(arm[3])) << sign * 0.09, 1.2, -0.25;
        for (std::size_t k = 0; k < middles.size(); ++k)
            curve.nodes.row(middles[k]) = (curve.nodes.row(joint(arm[k])) + curve.nodes.row(joint(arm[k + 1]))) / 2;
    }
    curve.edges.push_back({std::min(left, right), std::max(left, right)});
    const LoopCuts cuts = best_cuts(curve);
    REQUIRE(cuts.size() == 1);
    const bool of_left = contains(cuts[0].limb, left);
    CHECK(contains(cuts[0].limb, of_left ? left : right));
    CHECK(contains(cuts[0].other, of_left ? right : left));
    CHECK_FALSE(contains(cuts[0].limb, joint("chest")));
}

TEST_CASE("a hand on a thigh is cut from the thigh, and stays with its arm") {
    CurveSkeleton<double> curve = human_curve();
    const int hand = tip(curve, "left_hand"), thigh = middle_of_bone(curve, "left_hip", "left_knee");
    curve.edges.push_back({std::min(hand, thigh), std::max(hand, thigh)});
    const LoopCuts cuts = best_cuts(curve);
    REQUIRE(cuts.size() == 1);
    CHECK(cuts[0].limb.front() == hand);
    CHECK(contains(cuts[0].limb, joint("left_hand")));
    CHECK(contains(cuts[0].other, thigh));
    CHECK(contains(cuts[0].other, joint("left_knee")));
    CHECK_FALSE(contains(cuts[0].other, joint("left_elbow")));
    CHECK_FALSE(contains(cuts[0].other, joint("left_shoulder")));
}

TEST_CASE("both hands on the thighs are two cuts") {
    CurveSkeleton<double> curve = human_curve();
    for (const std::string side : {"left", "right"}) {
        const int hand = tip(curve, side + "_hand");
        const int thigh = middle_of_bone(curve, side + "_hip", side + "_knee");
        curve.edges.push_back({std::min(hand, thigh), std::max(hand, thigh)});
    }
    const LoopCuts cuts = best_cuts(curve);
    REQUIRE(cuts.size() == 2);
    std::vector<int> firsts{cuts[0].limb.front(), cuts[1].limb.front()};
    std::sort(firsts.begin(), firsts.end());
    std::vector<int> hands{tip(curve, "left_hand"), tip(curve, "right_hand")};
    std::sort(hands.begin(), hands.end());
    CHECK(firsts == hands);
}

TEST_CASE("what the template fits badly however its loops are opened is not cut") {
    CurveSkeleton<double> curve = human_curve();
    const int hand = tip(curve, "left_hand"), thigh = middle_of_bone(curve, "left_hip", "left_knee");
    curve.edges.push_back({std::min(hand, thigh), std::max(hand, thigh)});
    for (const char* name : {"right_wrist", "right_hand", "left_ankle", "left_foot"}) // far beyond where they end
        curve.nodes.row(joint(name)) *= 3;
    for (const char* name : {"right_hand", "left_foot"}) curve.nodes.row(tip(curve, name)) *= 3;
    REQUIRE(contact_count(curve) == 1);
    CHECK(find_loop_cuts(curve, human()).empty());
}

TEST_CASE("a turned curve is cut in the same places, also where left and right are equally good") {
    CurveSkeleton<double> curve = human_curve();
    for (const std::string side : {"left", "right"}) {
        const int hand = tip(curve, side + "_hand");
        const int thigh = middle_of_bone(curve, side + "_hip", side + "_knee");
        curve.edges.push_back({std::min(hand, thigh), std::max(hand, thigh)});
    }
    const LoopCuts expected = best_cuts(curve);
    REQUIRE(expected.size() == 2);
    for (const double angle : {0.3, 1.1, 2.7, 4.4}) {
        CurveSkeleton<double> turned = curve;
        const Vector3<double> axis = Vector3<double>(1, 2, angle).normalized();
        turned.nodes = curve.nodes * Eigen::AngleAxisd(angle, axis).toRotationMatrix();
        const LoopCuts cuts = best_cuts(turned);
        REQUIRE(cuts.size() == 2);
        for (std::size_t i = 0; i < 2; ++i) {
            CHECK(cuts[i].limb == expected[i].limb);
            CHECK(cuts[i].other == expected[i].other);
        }
    }
}

TEST_CASE("a curve with many loops is left as it is") {
    CurveSkeleton<double> curve = human_curve();
    const int foot = tip(curve, "left_foot");
    for (const char* name : {"waist", "chest", "neck", "head", "left_elbow", "right_elbow", "right_knee"})
        curve.edges.push_back({joint(name), foot});
    CHECK(find_loop_cuts(curve, human()).empty());
}

TEST_CASE("in float, a curve is cut in the same places") {
    CurveSkeleton<double> curve = human_curve();
    const int hand = tip(curve, "left_hand"), thigh = middle_of_bone(curve, "left_hip", "left_knee");
    curve.edges.push_back({std::min(hand, thigh), std::max(hand, thigh)});
    const LoopCuts expected = best_cuts(curve);
    const std::vector<LoopCuts> ways = find_loop_cuts(in_precision<float>(curve), human());
    REQUIRE(!ways.empty());
    REQUIRE(ways.front().size() == 1);
    CHECK(ways.front()[0].limb == expected[0].limb);
    CHECK(ways.front()[0].other == expected[0].other);
}

TEST_CASE("a loop in a curve that the template does not fit is not cut; a wrong option is an error all the same") {
    CurveSkeleton<double> ring; // with two tails
    ring.nodes.resize(6, 3);
    ring.nodes << 1, 0, 0, 0, 1, 0, -1, 0, 0, 0, -1, 0, 2, 0, 0, -2, 0, 0;
    ring.edges = {{0, 1}, {1, 2}, {2, 3}, {0, 3}, {0, 4}, {2, 5}};
    ring.regions.resize(6);
    ring.radii.assign(6, 0.01);
    CHECK(find_loop_cuts(ring, human()).empty());
    MatchingOptions options;
    options.distance_weight = -1;
    CHECK_THROWS_AS(find_loop_cuts(ring, human(), options), Error);
}
