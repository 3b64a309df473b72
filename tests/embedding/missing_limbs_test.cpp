#include <algorithm>
#include <string>
#include <vector>

#include <skelgen/embedding/impl/missing_limbs.hpp>
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

/// The curve without the bone from one joint to the next, and what lies beyond that.
CurveSkeleton<double> cut_off(const CurveSkeleton<double>& curve, const std::string& joint, const std::string& next) {
    const int from = joint_named(joint);
    std::vector<bool> is_off(static_cast<std::size_t>(curve.nodes.rows()), false);
    const auto off = [&](int node) { return is_off[static_cast<std::size_t>(node)]; };
    std::vector<int> todo{joint_named(next)};
    while (!todo.empty()) {
        const int node = todo.back();
        todo.pop_back();
        if (off(node) || node == from) continue;
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

/// The template from there on without a limb.
SkeletonTemplate lacking(const std::string& first) {
    return without_limb(builtin_template("human21"), joint_named(first));
}

double fit(const CurveSkeleton<double>& curve, const SkeletonTemplate& part) {
    const auto found = embed(curve, part);
    REQUIRE(found);
    return distortion_per_pair(*found);
}

} // namespace

TEST_CASE("a limb that is absent is so with all that follows, and leaves a bare joint in the trunk") {
    const SkeletonTemplate armless = lacking("left_elbow");
    for (std::size_t j = 0; j < armless.joints.size(); ++j) {
        INFO(armless.joints[j].name);
        const bool is_off = armless.joints[j].name == "left_elbow" || armless.joints[j].name == "left_wrist" ||
                            armless.joints[j].name == "left_hand";
        CHECK(armless.joints[j].is_absent == is_off);
        CHECK(is_bare(armless, static_cast<int>(j)) == (armless.joints[j].name == "left_shoulder"));
    }
    const SkeletonTemplate without_forearm = lacking("left_wrist");
    CHECK_FALSE(is_bare(without_forearm, joint_named("left_shoulder")));
    CHECK(without_forearm.joint(joint_named("left_elbow")).tip.has_value()); // the limb goes on a little
}

TEST_CASE("a body that lacks a limb has as many ends and junctions less as the limb brings") {
    std::vector<std::size_t> nodes;
    for (const SkeletonTemplate& part : detail::partial_templates(builtin_template("human21")))
        nodes.push_back(reduce<double>(part).origin.size());
    CHECK(nodes == std::vector<std::size_t>{6, 6, 5, 7, 7});                       // head, arm, leg, forearm, calf
    CHECK(detail::partial_templates(builtin_template("pinocchio18")).size() == 4); // it has no wrists
}

TEST_CASE("a curve without a limb fits the template without that limb, and worse those without another") {
    const CurveSkeleton<double> whole = human_curve();
    const SkeletonTemplate head = lacking("head"), arm = lacking("left_elbow");
    // Without a head nor a stump of its neck the chest has three branches, as without an arm.
    CHECK(fit(cut_off(whole, "chest", "neck"), head) < 1e-3);
    CHECK(fit(cut_off(whole, "chest", "neck"), arm) > 5e-3);
    CHECK(fit(cut_off(whole, "chest", "right_shoulder"), arm) < 1e-3);
    CHECK(fit(cut_off(whole, "chest", "right_shoulder"), head) > 5e-3);
}

TEST_CASE("without a leg the root is no junction: one chain leads past it from the chest to the other foot") {
    const auto found = embed(cut_off(human_curve(), "crotch", "left_hip"), lacking("left_knee"));
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

TEST_CASE("the limb that a curve lacks is the first of those that it may lack, and each way comes once") {
    const SkeletonTemplate& human = builtin_template("human21");
    const CurveSkeleton<double> armless = cut_off(human_curve(), "chest", "right_shoulder");
    const std::vector<LaidTemplate> found = without_a_limb(armless, human, 4);
    REQUIRE(!found.empty());
    for (std::size_t j = 0; j < human.joints.size(); ++j)
        CHECK(found.front().skeleton_template.joints[j].is_absent == lacking("left_elbow").joints[j].is_absent);
    for (std::size_t i = 1; i < found.size(); ++i) {
        CHECK(distortion_per_pair(found[i].embedding) >= distortion_per_pair(found[i - 1].embedding));
        CHECK(detail::nodes_by_role(found[i]) != detail::nodes_by_role(found[i - 1]));
    }
    CHECK(without_a_limb(armless, human, 1).size() == 1);
    CHECK(without_a_limb(armless, lacking("left_elbow"), 4).empty()); // it lacks one already
}
