#include <algorithm>
#include <string>
#include <vector>

#include <skelgen/embedding/missing_limbs.hpp>
#include <skelgen/embedding/reduced_graph.hpp>

#include "catch.hpp"
#include "embedding/human_curve.hpp"

using namespace skelgen;
using namespace skelgen::embedding;
using namespace skelgen::test;

namespace {

int joint_named(const std::string& name) {
    const SkeletonTemplate& human = builtin_template("human21");
    for (std::size_t j = 0; j < human.joints.size(); ++j)
        if (human.joints[j].name == name) return static_cast<int>(j);
    return -1;
}

enum class Stump { none, half_a_bone };

/// The curve without what lies beyond the bone from one joint to the next, and without that bone or half of it.
CurveSkeleton<double> cut_off(const CurveSkeleton<double>& curve, const std::string& joint, const std::string& next,
                              Stump stump) {
    const int from = joint_named(joint);
    std::vector<bool> is_off(static_cast<std::size_t>(curve.nodes.rows()), false);
    const auto off = [&](int node) { return is_off[static_cast<std::size_t>(node)]; };
    std::vector<int> todo{joint_named(next)};
    while (!todo.empty()) {
        const int node = todo.back();
        todo.pop_back();
        const bool is_half = std::any_of(curve.edges.begin(), curve.edges.end(), [&](const auto& edge) {
            return (edge[0] == from && edge[1] == node) || (edge[1] == from && edge[0] == node);
        });
        if (off(node) || node == from || (is_half && stump == Stump::half_a_bone)) continue;
        is_off[static_cast<std::size_t>(node)] = true;
        for (const auto& [a, b] : curve.edges) {
            if (a == node) todo.push_back(b);
            if (b == node) todo.push_back(a);
        }
    }
    std::vector<int> renamed;
    CurveSkeleton<double> out;
    for (Eigen::Index v = 0; v < curve.nodes.rows(); ++v) {
        renamed.push_back(static_cast<int>(out.nodes.rows()));
        if (off(static_cast<int>(v))) continue;
        out.nodes.conservativeResize(out.nodes.rows() + 1, 3);
        out.nodes.bottomRows<1>() = curve.nodes.row(v);
        out.radii.push_back(curve.radii[static_cast<std::size_t>(v)]);
        out.regions.push_back({renamed.back()});
    }
    for (const auto& [a, b] : curve.edges)
        if (!off(a) && !off(b))
            out.edges.push_back({renamed[static_cast<std::size_t>(a)], renamed[static_cast<std::size_t>(b)]});
    return out;
}

PartialTemplate lacking(const std::string& end, const std::string& first) {
    return {without_limb(builtin_template("human21"), joint_named(first)), joint_named(end)};
}

double fit(const CurveSkeleton<double>& curve, const PartialTemplate& part) {
    const auto found = embed(curve, part.skeleton_template);
    REQUIRE(found);
    return distortion_per_pair(*found);
}

} // namespace

TEST_CASE("a limb that is absent is so with all that follows, and leaves a bare joint in the trunk") {
    const SkeletonTemplate armless = lacking("left_hand", "left_elbow").skeleton_template;
    for (std::size_t j = 0; j < armless.joints.size(); ++j) {
        INFO(armless.joints[j].name);
        const bool is_off = armless.joints[j].name == "left_elbow" || armless.joints[j].name == "left_wrist" ||
                            armless.joints[j].name == "left_hand";
        CHECK(armless.joints[j].is_absent == is_off);
        CHECK(is_bare(armless, static_cast<int>(j)) == (armless.joints[j].name == "left_shoulder"));
    }
    const SkeletonTemplate without_forearm = lacking("left_hand", "left_wrist").skeleton_template;
    CHECK_FALSE(is_bare(without_forearm, joint_named("left_shoulder")));
    CHECK(without_forearm.joint(joint_named("left_elbow")).tip.has_value()); // the limb goes on a little
}

TEST_CASE("a body that lacks a limb has as many ends and junctions less as the limb brings") {
    std::vector<std::size_t> nodes;
    for (const PartialTemplate& part : partial_templates(builtin_template("human21")))
        nodes.push_back(reduce<double>(part.skeleton_template).origin.size());
    CHECK(nodes == std::vector<std::size_t>{6, 6, 5, 7, 7});               // head, arm, leg, forearm, calf
    CHECK(partial_templates(builtin_template("pinocchio18")).size() == 4); // it has no wrists
}

TEST_CASE("a curve without a limb fits the template without that limb, and worse those without another") {
    const CurveSkeleton<double> whole = human_curve();
    const PartialTemplate head = lacking("head", "head"), arm = lacking("left_hand", "left_elbow");
    // Without a head nor a stump of its neck the chest has three branches, as without an arm.
    CHECK(fit(cut_off(whole, "chest", "neck", Stump::none), head) < 1e-3);
    CHECK(fit(cut_off(whole, "chest", "neck", Stump::none), arm) > 5e-3);
    CHECK(fit(cut_off(whole, "chest", "right_shoulder", Stump::none), arm) < 1e-3);
    CHECK(fit(cut_off(whole, "chest", "right_shoulder", Stump::none), head) > 5e-3);
}

TEST_CASE("without a leg the root is no junction: one chain leads past it from the chest to the other foot") {
    const PartialTemplate leg = lacking("left_foot", "left_knee");
    const auto found = embed(cut_off(human_curve(), "crotch", "left_hip", Stump::none), leg.skeleton_template);
    REQUIRE(found);
    CHECK(found->matched_nodes == 5);
    CHECK(distortion_per_pair(*found) < 1e-3);
    const auto chain = std::find_if(found->chains.begin(), found->chains.end(), [](const Chain& each) {
        return std::find(each.joints.begin(), each.joints.end(), 0) != each.joints.end();
    });
    REQUIRE(chain != found->chains.end());
    std::vector<int> expected;
    for (const char* name : {"chest", "waist", "crotch", "right_hip", "right_knee", "right_ankle", "right_foot"})
        expected.push_back(joint_named(name));
    CHECK(chain->joints == expected);
}

TEST_CASE("a stump is no limb: what stands for it in the whole template is much too short") {
    const SkeletonTemplate& human = builtin_template("human21");
    const CurveSkeleton<double> whole = human_curve();
    const auto missing = [&](const CurveSkeleton<double>& curve) {
        const auto found = embed(curve, human);
        REQUIRE(found);
        return find_missing_limb(curve, human, *found);
    };
    CHECK_FALSE(missing(whole));
    const auto arm = missing(cut_off(whole, "left_shoulder", "left_elbow", Stump::half_a_bone));
    REQUIRE(arm);
    CHECK(human.joint(arm->end).role == JointRole::hand);
    CHECK(arm->skeleton_template.joint(joint_named("left_elbow")).is_absent);
    const auto head = missing(cut_off(whole, "neck", "head", Stump::half_a_bone));
    REQUIRE(head);
    CHECK(human.joint(head->end).role == JointRole::head);
    // Hands that are cut off are the surface's to tell.
    CHECK_FALSE(missing(cut_off(whole, "left_wrist", "left_hand", Stump::half_a_bone)));
}

TEST_CASE("what swells beyond a neck is a head, however short") {
    const SkeletonTemplate& human = builtin_template("human21");
    CurveSkeleton<double> curve = cut_off(human_curve(), "neck", "head", Stump::half_a_bone);
    const auto found = embed(curve, human);
    REQUIRE(found);
    const auto chain = std::find_if(found->chains.begin(), found->chains.end(),
                                    [](const Chain& each) { return each.joints.back() == joint_named("head"); });
    REQUIRE(chain != found->chains.end());
    REQUIRE(chain->nodes.size() == 4); // the chest, the neck, a node between them, and the end
    const auto is_missing = [&](const std::vector<double>& radii) {
        for (std::size_t i = 0; i < radii.size(); ++i)
            curve.radii[static_cast<std::size_t>(chain->nodes[i])] = radii[i];
        return find_missing_limb(curve, human, *found).has_value();
    };
    CHECK(is_missing({0.1, 0.09, 0.08, 0.08}));
    CHECK_FALSE(is_missing({0.1, 0.07, 0.06, 0.08}));
    CHECK(is_missing({0.06, 0.06, 0.06, 0.08})); // a neck is thinner than what it stands on, too
    CHECK(is_missing({0.3, 0.07, 0.06, 0.08}));  // what is so small is no head
}
