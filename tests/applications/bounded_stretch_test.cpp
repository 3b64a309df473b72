#include <numbers>

#include <skelgen/applications/impl/bones.hpp>
#include <skelgen/applications/impl/bounded_stretch.hpp>

#include "catch.hpp"
#include "human.hpp"
#include "sleeve.hpp"

namespace {

using namespace skelgen;
using namespace skelgen::applications;
using test::human;
using test::sleeve;

/// The most that an edge grows when a joint bends by 90 degrees and a vertex follows it by the given weights.
double most_growth(const TriangleMesh<double>& mesh, const Eigen::VectorXd& weight, const Eigen::Vector3d& joint) {
    const Eigen::Matrix3d bend(Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitY()));
    const auto moved = [&](int v) -> Eigen::Vector3d {
        const Eigen::Vector3d p = mesh.vertices.row(v).transpose();
        return (1 - weight[v]) * p + weight[v] * (joint + bend * (p - joint));
    };
    double most = 0;
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int a = mesh.faces(f, k), b = mesh.faces(f, (k + 1) % 3);
            most = std::max(most, (moved(a) - moved(b)).norm() / (mesh.vertices.row(a) - mesh.vertices.row(b)).norm());
        }
    return most;
}

TEST_CASE("stretch: an abrupt bend is spread until no edge grows too much", "[applications][weights]") {
    const auto rest = rest_skeleton<double>(human());
    const TriangleMesh<double> tube = sleeve(rest);
    const int shoulder = find_joint(rest, "left_shoulder"), elbow = find_joint(rest, "left_elbow");
    const Eigen::Vector3d joint = rest.joints[static_cast<std::size_t>(elbow)].position;
    JointWeights weights = JointWeights::Zero(tube.vertices.rows(), static_cast<Eigen::Index>(rest.joints.size()));
    for (Eigen::Index v = 0; v < weights.rows(); ++v)
        weights(v, tube.vertices(v, 0) > joint.x() ? elbow : shoulder) = 1;
    CHECK(most_growth(tube, weights.col(elbow), joint) > 5);
    std::vector<int> limb(rest.joints.size(), -1);
    for (const char* name : {"left_shoulder", "left_elbow", "left_wrist", "left_hand"})
        limb[static_cast<std::size_t>(find_joint(rest, name))] = 0;
    const std::vector<RigidMotion<double>> none(rest.joints.size());
    const RestingSurface<double> surface{tube.vertices, none, rest, human_axes()};
    const JointWeights even = with_bounded_stretch(weights, surface, tube.faces, human(), limb);
    CHECK(most_growth(tube, even.col(elbow), joint) < 3.1); // ends within its rounds
    CHECK((even.rowwise().sum().array() - 1).abs().maxCoeff() < 1e-12);
    CHECK(even.minCoeff() >= 0);
    for (Eigen::Index v = 0; v < weights.rows(); ++v) // far from the bend nothing has changed
        if (std::abs(tube.vertices(v, 0) - joint.x()) > 0.06) CHECK(even.row(v) == weights.row(v));

    CHECK(with_bounded_stretch(even, surface, tube.faces, human(), limb).isApprox(even, 0.02));
    weights.setZero();
    weights.col(elbow).setOnes();
    CHECK(with_bounded_stretch(weights, surface, tube.faces, human(), limb) == weights);
}

TEST_CASE("stretch: a limb that comes bent is seen as it is once it is straight", "[applications][weights]") {
    const auto rest = rest_skeleton<double>(human());
    const test::BentSleeve bent = test::bent_sleeve(rest, 2.0);
    const int elbow = find_joint(rest, "left_elbow");
    const Eigen::Vector3d joint = rest.joints[static_cast<std::size_t>(elbow)].position;
    const JointWeights weights = test::sleeve_weights(sleeve(rest).vertices, rest, 0, 40 / test::sleeve_radius);
    std::vector<int> limb(rest.joints.size(), -1);
    for (const char* name : {"left_shoulder", "left_elbow", "left_wrist", "left_hand"})
        limb[static_cast<std::size_t>(find_joint(rest, name))] = 0;
    const RestingSurface<double> surface{bent.mesh.vertices, bent.motions, rest, human_axes()};
    const auto growth = [&](const JointWeights& by) {
        return most_growth({at_rest(surface, by), bent.mesh.faces}, by.col(elbow), joint);
    };
    CHECK(growth(weights) > 3.3);
    CHECK(growth(with_bounded_stretch(weights, surface, bent.mesh.faces, human(), limb)) < 3.1);
}

TEST_CASE("stretch: where two limbs meet they stay apart", "[applications][weights]") {
    const auto rest = rest_skeleton<double>(human());
    const TriangleMesh<double> tube = sleeve(rest);
    const int left = find_joint(rest, "left_hip"), right = find_joint(rest, "right_hip");
    JointWeights weights = JointWeights::Zero(tube.vertices.rows(), static_cast<Eigen::Index>(rest.joints.size()));
    for (Eigen::Index v = 0; v < weights.rows(); ++v) weights(v, tube.vertices(v, 0) > 0.45 ? left : right) = 1;
    std::vector<int> limb(rest.joints.size(), -1);
    limb[static_cast<std::size_t>(left)] = 0;
    limb[static_cast<std::size_t>(right)] = 1;
    const std::vector<RigidMotion<double>> none(rest.joints.size());
    const RestingSurface<double> surface{tube.vertices, none, rest, human_axes()};
    CHECK(with_bounded_stretch(weights, surface, tube.faces, human(), limb) == weights);
}

} // namespace
