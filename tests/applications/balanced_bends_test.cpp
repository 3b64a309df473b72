#include <cmath>

#include <skelgen/applications/balanced_bends.hpp>
#include <skelgen/applications/bones.hpp>

#include "catch.hpp"
#include "human.hpp"
#include "sleeve.hpp"

namespace {

using namespace skelgen;
using namespace skelgen::applications;
using test::human;

constexpr double sleeve_radius = 0.04, odds_steepness = 12 / sleeve_radius; // of the odds' logarithm along the arm

/// Weights of a sleeve whose border lies beyond the elbow.
JointWeights weights_with_border(const Points<double>& vertices, const KinematicSkeleton<double>& rest, double border) {
    const int shoulder = find_joint(rest, "left_shoulder"), elbow = find_joint(rest, "left_elbow");
    const double joint = rest.joints[static_cast<std::size_t>(elbow)].position.x();
    JointWeights weights = JointWeights::Zero(vertices.rows(), static_cast<Eigen::Index>(rest.joints.size()));
    for (Eigen::Index v = 0; v < weights.rows(); ++v) {
        weights(v, elbow) = 1 / (1 + std::exp(-odds_steepness * (vertices(v, 0) - joint - border)));
        weights(v, shoulder) = 1 - weights(v, elbow);
    }
    return weights;
}

TEST_CASE("balanced bends: in the middle of a tube the border goes to the joint", "[applications][weights]") {
    const auto rest = rest_skeleton<double>(human());
    const TriangleMesh<double> tube = test::sleeve(rest);
    const int elbow = find_joint(rest, "left_elbow");
    const double joint = rest.joints[static_cast<std::size_t>(elbow)].position.x();
    for (const double border : {-0.3 * sleeve_radius, 0.0, 0.3 * sleeve_radius}) {
        const JointWeights before = weights_with_border(tube.vertices, rest, border);
        const JointWeights after = with_balanced_bends<double>(before, {tube.vertices, rest}, tube.faces, human());
        CHECK((after.rowwise().sum().array() - 1).abs().maxCoeff() < 1e-12);
        for (Eigen::Index v = 0; v < after.rows(); ++v) {
            const double share = after(v, elbow);
            if (share < 0.01 || share > 0.99) continue;
            const double is = tube.vertices(v, 0) - joint - std::log(share / (1 - share)) / odds_steepness;
            CHECK(std::abs(is) < 0.12 * sleeve_radius); // its two halves are not quite as long
        }
    }
}

TEST_CASE("balanced bends: what follows one joint alone stays", "[applications][weights]") {
    const auto rest = rest_skeleton<double>(human());
    const TriangleMesh<double> tube = test::sleeve(rest);
    JointWeights weights = JointWeights::Zero(tube.vertices.rows(), static_cast<Eigen::Index>(rest.joints.size()));
    weights.col(find_joint(rest, "left_elbow")).setOnes();
    CHECK(with_balanced_bends<double>(weights, {tube.vertices, rest}, tube.faces, human()) == weights);
}

} // namespace
