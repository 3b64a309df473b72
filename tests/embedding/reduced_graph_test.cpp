#include <algorithm>
#include <cmath>
#include <type_traits>

#include <skelgen/core/builtin_templates.hpp>
#include <skelgen/embedding/reduced_graph.hpp>

#include "catch.hpp"
#include "embedding/human_curve.hpp"

using namespace skelgen;
using namespace skelgen::embedding;
using namespace skelgen::test;

namespace {

/// Node 1 joins three arms of length 1, 2 and 3, each with a node of degree 2 on the way.
CurveSkeleton<double> three_arms() {
    CurveSkeleton<double> curve;
    curve.nodes.resize(7, 3);
    curve.nodes << 1, 0, 0, 0, 0, 0, 0, 2, 0, 0, 0, 3, 0.5, 0, 0, 0, 0.5, 0, 0, 0, 2;
    curve.edges = {{1, 4}, {0, 4}, {1, 5}, {2, 5}, {1, 6}, {3, 6}};
    curve.regions.resize(7);
    curve.radii.assign(7, 0.1);
    return curve;
}

} // namespace

TEMPLATE_TEST_CASE("reducing takes out the nodes of degree 2 and keeps the distances along the curve", "", float,
                   double) {
    const ReducedGraph<TestType> reduced = reduce(in_precision<TestType>(three_arms()));
    REQUIRE(reduced.origin == std::vector<int>{0, 1, 2, 3});
    CHECK(reduced.degree == std::vector<int>{1, 3, 1, 1});
    Eigen::Matrix4d expected;
    expected << 0, 1, 3, 4, 1, 0, 2, 3, 3, 2, 0, 5, 4, 3, 5, 0;
    const double rounding = std::is_same_v<TestType, double> ? 1e-12 : 1e-6;
    CHECK((reduced.distances.template cast<double>() - expected / 5).cwiseAbs().maxCoeff() < rounding);
}

TEST_CASE("human21 reduces to head, chest, crotch, two hands and two feet") {
    const SkeletonTemplate& human = builtin_template("human21");
    const ReducedGraph<double> reduced = reduce<double>(human);
    std::vector<std::string> names;
    for (std::size_t i = 0; i < reduced.origin.size(); ++i) {
        const std::string& name = human.joints[static_cast<std::size_t>(reduced.origin[i])].name;
        names.push_back(name);
        CHECK(reduced.degree[i] == (name == "chest" ? 4 : name == "crotch" ? 3 : 1));
    }
    std::sort(names.begin(), names.end());
    CHECK(names ==
          std::vector<std::string>{"chest", "crotch", "head", "left_foot", "left_hand", "right_foot", "right_hand"});
    CHECK(reduced.distances.maxCoeff() == Approx(1));
    CHECK((reduced.distances - reduced.distances.transpose()).cwiseAbs().maxCoeff() < 1e-12);
}

TEST_CASE("the longest path of human21 leads from a toe to the fingertip on the other side") {
    const SkeletonTemplate& human = builtin_template("human21");
    const auto at = [&](const std::string& name) {
        return std::find_if(human.joints.begin(), human.joints.end(), [&](const auto& j) { return j.name == name; });
    };
    double length = 0;
    for (const char* end : {"left_foot", "right_hand"}) {
        auto joint = at(end);
        length += (*joint->tip - joint->position).norm();
        while (joint->name != "chest" && joint->parent >= 0) {
            const TemplateJoint& parent = human.joints[static_cast<std::size_t>(joint->parent)];
            length += (joint->position - parent.position).norm();
            joint = at(parent.name);
        }
    }
    for (const char* trunk : {"chest", "waist"})
        length += (at(trunk)->position - human.joints[static_cast<std::size_t>(at(trunk)->parent)].position).norm();
    CHECK(longest_path(human) == Approx(length));
}

TEST_CASE("a template twice as large reduces to the same graph") {
    SkeletonTemplate large = builtin_template("human21");
    for (TemplateJoint& joint : large.joints) {
        joint.position *= 2;
        if (joint.tip) *joint.tip *= 2;
    }
    CHECK(reduce<double>(large).distances.isApprox(reduce<double>(builtin_template("human21")).distances));
    CHECK(longest_path(large) == Approx(2 * longest_path(builtin_template("human21"))));
}

TEST_CASE("an end is as thick as the curve is at its thickest within a tenth of the longest path") {
    CurveSkeleton<double> curve = three_arms();
    // The arm of length 3 has nodes 0.4 and 0.6 from its end; the longest path is 5.
    curve.nodes.conservativeResize(9, 3);
    curve.nodes.bottomRows<2>() << 0, 0, 2.6, 0, 0, 2.4;
    curve.edges = {{1, 4}, {0, 4}, {1, 5}, {2, 5}, {1, 6}, {6, 8}, {7, 8}, {3, 7}};
    curve.regions.resize(9);
    curve.radii = {0.1, 0.1, 0.1, 0.1, 0.1, 0.1, 0.9, 0.3, 0.7};
    const ReducedGraph<double> reduced = reduce(curve);
    REQUIRE(reduced.origin == std::vector<int>{0, 1, 2, 3});
    CHECK(reduced.radius[0] == Approx(0.1 / 5));
    CHECK(reduced.radius[1] == 0); // no end
    CHECK(reduced.radius[3] == Approx(0.3 / 5));
}

TEST_CASE("the template's reduced graph is the same in float to rounding") {
    const SkeletonTemplate& human = builtin_template("human21");
    const ReducedGraph<double> exact = reduce<double>(human);
    const ReducedGraph<float> rounded = reduce<float>(human);
    CHECK(rounded.origin == exact.origin);
    CHECK(rounded.degree == exact.degree);
    CHECK((rounded.distances.cast<double>() - exact.distances).cwiseAbs().maxCoeff() < 1e-6);
    for (std::size_t i = 0; i < exact.radius.size(); ++i)
        CHECK(double{rounded.radius[i]} == Approx(exact.radius[i]).epsilon(1e-5));
}
