#include <cmath>

#include <skelgen/applications/impl/bones.hpp>
#include <skelgen/applications/impl/deep_shoulders.hpp>

#include "catch.hpp"
#include "human.hpp"

namespace {

using namespace skelgen;
using namespace skelgen::applications;

TEMPLATE_TEST_CASE("deep shoulders: beside the upper third of the upper arm more follows the arm, all in proportion",
                   "[applications][weights]", float, double) {
    const auto rest = rest_skeleton<TestType>(test::human());
    const auto at = [](JointRole role) { return Eigen::Index(find_joint(test::human(), role, Side::left)); };
    const Eigen::Index chest = find_joint(test::human(), JointRole::chest),
                       neck = find_joint(test::human(), JointRole::neck), shoulder = at(JointRole::shoulder),
                       elbow = at(JointRole::elbow);
    const Vector3<TestType> top = rest.joints[static_cast<std::size_t>(shoulder)].position;
    const Vector3<TestType> end = rest.joints[static_cast<std::size_t>(elbow)].position;
    const std::vector<double> along{-0.5, 0.2, 0.4, 0.55, 0.7, 1, 1.4}; // from the elbow to the shoulder
    const std::vector<double> expected{0, 0, 0, 1, 2, 2, 2};            // logarithms
    const auto n = static_cast<Eigen::Index>(along.size());
    Points<TestType> vertices(n, 3);
    JointWeights weights = JointWeights::Zero(n, Eigen::Index(test::human().joints.size()));
    for (Eigen::Index v = 0; v < n; ++v) {
        vertices.row(v) = (end + static_cast<TestType>(along[static_cast<std::size_t>(v)]) * (top - end)).transpose();
        vertices(v, 1) += TestType(0.05); // across the arm, which is level
        weights(v, chest) = 0.6;          // 9 to 1
        weights(v, neck) = 0.3;
        weights(v, shoulder) = 0.08;
        weights(v, elbow) = 0.02;
    }
    const JointWeights deep = with_deep_shoulders<TestType>(weights, vertices, rest, test::human());
    CHECK((deep.rowwise().sum().array() - 1).abs().maxCoeff() < 1e-15);
    for (Eigen::Index v = 0; v < n; ++v) {
        INFO("at " << along[static_cast<std::size_t>(v)] << " of the upper arm");
        const double odds = (deep(v, shoulder) + deep(v, elbow)) / (deep(v, chest) + deep(v, neck));
        CHECK(std::log(9 * odds) == Approx(expected[static_cast<std::size_t>(v)]).margin(1e-5));
        CHECK(deep(v, shoulder) == Approx(4 * deep(v, elbow)));
        CHECK(deep(v, chest) == Approx(2 * deep(v, neck)));
    }
}

TEST_CASE("deep shoulders: what follows the arm alone, or nothing of it, keeps its weights",
          "[applications][weights]") {
    const auto rest = rest_skeleton<double>(test::human());
    const Eigen::Index shoulder = find_joint(test::human(), JointRole::shoulder, Side::left),
                       hip = find_joint(test::human(), JointRole::hip, Side::left),
                       chest = find_joint(test::human(), JointRole::chest);
    JointWeights weights = JointWeights::Zero(2, Eigen::Index(test::human().joints.size()));
    weights(0, shoulder) = 1;
    weights(1, chest) = 0.3;
    weights(1, hip) = 0.7;
    Points<double> vertices(2, 3);
    for (Eigen::Index v = 0; v < 2; ++v)
        vertices.row(v) = rest.joints[static_cast<std::size_t>(shoulder)].position.transpose();
    CHECK(with_deep_shoulders<double>(weights, vertices, rest, test::human()) == weights);
}

} // namespace
