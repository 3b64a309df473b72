#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include <skelgen/core/builtin_templates.hpp>
#include <skelgen/core/curve_graph.hpp>
#include <skelgen/core/error.hpp>
#include <skelgen/embedding/embed.hpp>

#include "catch.hpp"
#include "embedding/human_curve.hpp"
#include "mesh_changes.hpp"

using namespace skelgen;
using namespace skelgen::embedding;
using namespace skelgen::test;

namespace {

CurveSkeleton<double> path_of(int nodes) {
    CurveSkeleton<double> curve;
    curve.nodes = Points<double>::Zero(nodes, 3);
    for (int v = 0; v < nodes; ++v) {
        curve.nodes(v, 0) = v;
        if (v > 0) curve.edges.push_back({v - 1, v});
    }
    curve.regions.resize(static_cast<std::size_t>(nodes));
    curve.radii.assign(static_cast<std::size_t>(nodes), 0.1);
    return curve;
}

const std::string& joint_at(int node) {
    return builtin_template("human21").joints[static_cast<std::size_t>(node)].name;
}

/// The joint at the inner end of the limb that the tip `node` of human_curve() ends.
std::string limb_of(const CurveSkeleton<double>& curve, int node) {
    for (const auto& [a, b] : curve.edges)
        if (b == node) return joint_at(a);
    return {};
}

std::string without_side(std::string name) {
    for (const char* side : {"left_", "right_"})
        if (name.rfind(side, 0) == 0) name.erase(0, std::string(side).size());
    return name;
}

/// human21 in a curve that it fits.
Embedding embedded(const CurveSkeleton<double>& curve) {
    const Outcome<Embedding> found = embed(curve, builtin_template("human21"));
    REQUIRE(found);
    return *found;
}

/// The text of the failure to embed human21; empty where there is none.
std::string failure_of(const CurveSkeleton<double>& curve, Refusal reason = Refusal::too_few_ends) {
    const Outcome<Embedding> found = embed(curve, builtin_template("human21"));
    if (found) return {};
    CHECK(found.failure().reason == reason);
    return found.failure().what;
}

} // namespace

TEST_CASE("a curve with more ends than any body has is refused at once, with their number") {
    CurveSkeleton<double> star = path_of(2);
    for (int leaf = 2; leaf <= 200; ++leaf) {
        star.nodes.conservativeResize(leaf + 1, 3);
        star.nodes.row(leaf) << std::cos(leaf), std::sin(leaf), 0;
        star.edges.push_back({0, leaf});
        star.regions.emplace_back();
        star.radii.push_back(0.1);
    }
    const Outcome<Embedding> found = embed(star, builtin_template("human21"));
    REQUIRE_FALSE(found);
    CHECK(found.failure().reason == Refusal::too_many_ends);
    CHECK(found.failure().what.find("201 ends and junctions") != std::string::npos);
}

TEST_CASE("human21 embeds in its own bones: each joint of the reduced template at its node, up to left and right") {
    const CurveSkeleton<double> curve = human_curve();
    const SkeletonTemplate& human = builtin_template("human21");
    const Embedding embedding = embedded(curve);
    CHECK(embedding.matched_nodes == 7);
    REQUIRE(embedding.node_of_joint.size() == human.joints.size());
    std::set<int> used;
    for (std::size_t j = 0; j < human.joints.size(); ++j) {
        const std::string& name = human.joints[j].name;
        const int node = embedding.node_of_joint[j];
        INFO(name << " at node " << node);
        const bool is_end = without_side(name) == "hand" || without_side(name) == "foot" || name == "head";
        if (!is_end && name != "chest" && name != "crotch") {
            CHECK(node == -1);
            continue;
        }
        REQUIRE(node >= 0);
        CHECK(used.insert(node).second);
        if (is_end)
            CHECK(without_side(limb_of(curve, node)) == without_side(name));
        else
            CHECK(joint_at(node) == name);
    }
}

TEST_CASE("every bone of the template belongs to exactly one chain, which runs along connected nodes") {
    const CurveSkeleton<double> curve = human_curve();
    const SkeletonTemplate& human = builtin_template("human21");
    const Embedding embedding = embedded(curve);
    CHECK(embedding.chains.size() == 6); // head, two arms, two legs, and the trunk between chest and crotch
    std::multiset<int> lower_ends;
    const std::set<std::array<int, 2>> edges(curve.edges.begin(), curve.edges.end());
    for (const Chain& chain : embedding.chains) {
        REQUIRE(chain.joints.size() >= 2);
        for (std::size_t i = 1; i < chain.joints.size(); ++i) {
            CHECK(human.joints[static_cast<std::size_t>(chain.joints[i])].parent == chain.joints[i - 1]);
            lower_ends.insert(chain.joints[i]);
        }
        CHECK(chain.nodes.front() == embedding.node_of_joint[static_cast<std::size_t>(chain.joints.front())]);
        CHECK(chain.nodes.back() == embedding.node_of_joint[static_cast<std::size_t>(chain.joints.back())]);
        for (std::size_t i = 1; i < chain.nodes.size(); ++i) {
            const auto [low, high] = std::minmax({chain.nodes[i - 1], chain.nodes[i]});
            CHECK(edges.count({low, high}) == 1);
        }
    }
    CHECK(lower_ends.size() == human.joints.size() - 1);
    CHECK(std::set<int>(lower_ends.begin(), lower_ends.end()).size() == human.joints.size() - 1);
}

TEST_CASE("a curve with the arms leaving the spine at two junctions embeds all the same") {
    CurveSkeleton<double> curve = human_curve();
    const SkeletonTemplate& human = builtin_template("human21");
    const auto index = [&](const std::string& name) {
        return static_cast<int>(
            std::find_if(human.joints.begin(), human.joints.end(), [&](const auto& j) { return j.name == name; }) -
            human.joints.begin());
    };
    // The right arm hangs on the node half way between waist and chest instead of on the chest.
    const auto halfway = [&](int a, int b) {
        for (const auto& [c, d] : curve.edges)
            for (const auto& [e, f] : curve.edges)
                if (c == a && e == b && d == f) return d;
        return -1;
    };
    const int below = halfway(index("waist"), index("chest")), arm = halfway(index("chest"), index("right_shoulder"));
    for (auto& edge : curve.edges)
        if (edge == std::array<int, 2>{index("chest"), arm}) edge = {std::min(below, arm), std::max(below, arm)};
    const Embedding embedding = embedded(curve);
    CHECK(embedding.matched_nodes == 7);
    for (const char* end : {"left_hand", "right_hand", "head", "left_foot", "right_foot"}) {
        INFO(end);
        const int node = embedding.node_of_joint[static_cast<std::size_t>(index(end))];
        CHECK(without_side(limb_of(curve, node)) == without_side(end));
    }
}

TEST_CASE("a head that ends in two horns keeps its neck: where one chain passes, a fork is no junction of the body") {
    CurveSkeleton<double> curve = human_curve();
    const SkeletonTemplate& human = builtin_template("human21");
    const int neck = find_joint(human, JointRole::neck), head = find_joint(human, JointRole::head);
    curve.edges.push_back({head, static_cast<int>(curve.nodes.rows())});
    curve.nodes.conservativeResize(curve.nodes.rows() + 1, 3);
    curve.nodes.bottomRows(1) = curve.nodes.row(head) + Eigen::RowVector3d(0.15, 0.15, 0);
    curve.regions.emplace_back();
    curve.radii.push_back(0);
    const Embedding embedding = embedded(curve);
    const auto to_head = std::find_if(embedding.chains.begin(), embedding.chains.end(),
                                      [&](const Chain& chain) { return chain.joints.back() == head; });
    REQUIRE(to_head != embedding.chains.end());
    for (const int joint : {neck, head}) CHECK(std::count(to_head->nodes.begin(), to_head->nodes.end(), joint) == 1);
}

TEST_CASE("what goes on beyond the embedded template is measured") {
    CurveSkeleton<double> curve = human_curve();
    const Embedding bare = embedded(curve);
    CHECK(unmatched_reach(curve, bare) == 0);
    const double diameter = matched_diameter(curve, bare);
    double matched = 0;
    for (const Chain& chain : bare.chains)
        for (std::size_t i = 1; i < chain.nodes.size(); ++i)
            matched += (curve.nodes.row(chain.nodes[i]) - curve.nodes.row(chain.nodes[i - 1])).norm();
    // A tail of two pieces, 0.02 and 0.03 long, in the middle of a thin calf.
    curve.radii.assign(curve.radii.size(), 0.01);
    const int calf = bare.chains.back().nodes[bare.chains.back().nodes.size() / 2];
    const auto n = static_cast<int>(curve.nodes.rows());
    curve.nodes.conservativeResize(n + 2, 3);
    curve.nodes.row(n) = curve.nodes.row(calf) + Eigen::RowVector3d(0, 0, -0.02);
    curve.nodes.row(n + 1) = curve.nodes.row(n) + Eigen::RowVector3d(0, 0, -0.03);
    curve.edges.push_back({calf, n});
    curve.edges.push_back({n, n + 1});
    CHECK(unmatched_reach(curve, bare) == Approx(0.05 / matched));
    // A second one adds nothing.
    curve.nodes.conservativeResize(n + 3, 3);
    curve.nodes.row(n + 2) = curve.nodes.row(calf) + Eigen::RowVector3d(0, 0, 0.04);
    curve.edges.push_back({calf, n + 2});
    CHECK(unmatched_reach(curve, bare) == Approx(0.05 / matched));
    CHECK(matched_diameter(curve, bare) == diameter);
    // What ends within a thicker calf counts nothing, neither does all of a tail whose end alone does.
    curve.radii[static_cast<std::size_t>(calf)] = 0.045;
    curve.nodes.row(n + 1) = curve.nodes.row(calf) + Eigen::RowVector3d(0, 0, -0.01);
    curve.nodes.row(n) = curve.nodes.row(calf) + Eigen::RowVector3d(0, 0, -0.1);
    CHECK(unmatched_reach(curve, bare) == 0);
}

TEST_CASE("the longest way between the ends of the embedded template is one from a hand") {
    const CurveSkeleton<double> curve = human_curve();
    const Embedding found = embedded(curve);
    const core::CurveGraph<double> graph = core::curve_graph(curve);
    const auto node = [&](JointRole role, Side side) {
        return found.node_of_joint[static_cast<std::size_t>(find_joint(builtin_template("human21"), role, side))];
    };
    const auto way = [&](int from, int to) {
        return core::shortest_paths(graph, from).distance[static_cast<std::size_t>(to)];
    };
    const int hand = node(JointRole::hand, Side::left);
    const double longest = std::max(way(hand, node(JointRole::hand, Side::right)),
                                    way(hand, node(JointRole::foot, Side::right))); // all else is shorter
    CHECK(longest > 0);
    CHECK(matched_diameter(curve, found) == Approx(longest));
}

TEST_CASE("a curve with too few ends and junctions is no skeleton") {
    for (const int nodes : {2, 50})
        CHECK(failure_of(path_of(nodes)).find("has 2 ends and junctions, the template needs 7") != std::string::npos);
    CurveSkeleton<double> ring = path_of(12);
    ring.edges.push_back({0, 11});
    CHECK(failure_of(ring).find("has 0 ends and junctions") != std::string::npos);
    CurveSkeleton<double> nothing;
    nothing.nodes.resize(0, 3);
    CHECK(failure_of(nothing).find("has 0 ends and junctions") != std::string::npos);
}

TEST_CASE("a curve in several pieces is no skeleton") {
    CurveSkeleton<double> curve = human_curve();
    const std::size_t edges = curve.edges.size();
    // Without the waist's edges the legs are on their own.
    std::erase_if(curve.edges, [](const auto& e) { return e[0] == 1; });
    REQUIRE(curve.edges.size() < edges);
    CHECK(failure_of(curve, Refusal::curve_in_pieces).find("in several pieces") != std::string::npos);
}

TEST_CASE("in float, the same joints are at the same nodes") {
    const CurveSkeleton<double> curve = human_curve();
    const Embedding expected = embedded(curve);
    const auto rounded = in_precision<float>(curve);
    const Outcome<Embedding> found = embed(rounded, builtin_template("human21"));
    REQUIRE(found);
    CHECK(found->matched_nodes == 7);
    CHECK(found->distortion == Approx(expected.distortion).margin(1e-5));
    for (std::size_t j = 0; j < expected.node_of_joint.size(); ++j) {
        const int node = found->node_of_joint[j], other = expected.node_of_joint[j];
        REQUIRE((node < 0) == (other < 0));
        if (node >= 0) CHECK(without_side(limb_of(curve, node)) == without_side(limb_of(curve, other)));
    }
    CHECK(unmatched_reach(rounded, *found) == Approx(0).margin(1e-6));
}

TEST_CASE("options out of their range are refused, not taken for a curve that does not fit") {
    MatchingOptions options;
    options.distance_scale = 0;
    try {
        static_cast<void>(embed(human_curve(), builtin_template("human21"), options));
        FAIL("no error");
    } catch (const Error& error) {
        CHECK(error.code() == ErrorCode::usage);
    }
}
