#include <algorithm>
#include <numbers>
#include <vector>

#include <skelgen/applications/impl/bind.hpp>
#include <skelgen/applications/impl/loose_pieces.hpp>
#include <skelgen/core/shortest_turn.hpp>

#include "catch.hpp"
#include "human.hpp"
#include "mesh_changes.hpp"
#include "sample_body.hpp"
#include "shapes.hpp"
#include "weights.hpp"

namespace {

using namespace skelgen;
using namespace skelgen::applications;
using test::human;

const Joint<double>& joint(const char* name) {
    const KinematicSkeleton<double>& skeleton = test::sample_body().skeleton;
    return skeleton.joints[static_cast<std::size_t>(find_joint(skeleton, name))];
}

/// The skin of the sample body and what it wears, which it was not made of.
Skin<double> skin_with(const TriangleMesh<double>& worn) {
    const test::SampleBody& sample = test::sample_body();
    return bind(test::side_by_side(sample.mesh, worn), sample.body, sample.skeleton, human());
}

double followed(const Skin<double>& skin, Eigen::Index v, BodyPart part, Side side) {
    double sum = 0;
    for (int k = 0; k < Skin<double>::influences; ++k) {
        const TemplateJoint& of = human().joint(skin.joints(v, k));
        if (part_of(of.role) == part && of.side == side) sum += skin.weights(v, k);
    }
    return sum;
}

/// A rod of 8 mm from a place to another.
TriangleMesh<double> rod(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    TriangleMesh<double> out = test::capsule(0.008, (to - from).norm());
    const Eigen::Quaterniond turn = core::shortest_turn<double>(Eigen::Vector3d::UnitZ(), to - from);
    for (Eigen::Index v = 0; v < out.vertices.rows(); ++v)
        out.vertices.row(v) = (from + turn * out.vertices.row(v).transpose()).transpose();
    return out;
}

/// An open tube around the upright axis, 0.3 high.
TriangleMesh<double> skirt(const Eigen::Vector3d& middle, double radius) {
    constexpr int rings = 7, around = 48;
    const BodyFrame<double>& frame = test::sample_body().skeleton.frame;
    TriangleMesh<double> out{Points<double>(rings * around, 3), Triangles(2 * (rings - 1) * around, 3)};
    for (int i = 0; i < rings; ++i)
        for (int k = 0; k < around; ++k) {
            const Eigen::AngleAxisd turn(2 * std::numbers::pi * k / around, frame.up);
            out.vertices.row(i * around + k) =
                (middle + 0.05 * (i - rings / 2) * frame.up + radius * (turn * frame.left)).transpose();
            if (i == 0) continue;
            const int a = (i - 1) * around + k, b = (i - 1) * around + (k + 1) % around;
            out.faces.row(2 * a) << a, b, a + around;
            out.faces.row(2 * a + 1) << b, b + around, a + around;
        }
    return out;
}

TEST_CASE("loose pieces: a rod that a hand holds goes with it though it passes the knee, and so does a ball at its end",
          "[applications][weights]") {
    const BodyFrame<double>& frame = test::sample_body().skeleton.frame;
    const Eigen::Vector3d hand = joint("left_hand").position;
    const Eigen::Vector3d beside = joint("left_knee").position + 2 * joint("left_knee").radius * frame.left;
    const Eigen::Vector3d end = beside + 0.2 * (beside - hand);
    for (const double apart : {0.002, 0.02}) { // it touches the rod; it floats nearer to it than to the leg
        INFO(apart << " from the rod's end");
        TriangleMesh<double> ball = test::sphere(0.02, 4); // of more vertices than look for what is near
        REQUIRE(ball.vertices.rows() > 256);
        ball.vertices.rowwise() += (end + (0.028 + apart) * (end - hand).normalized()).transpose();
        const Skin<double> skin = skin_with(test::side_by_side(rod(hand, end), ball));
        for (Eigen::Index v = test::sample_body().mesh.vertices.rows(); v < skin.weights.rows(); ++v)
            if (followed(skin, v, BodyPart::arm, Side::left) < 0.999) FAIL("vertex " << v << " stays behind");
    }
}

TEST_CASE("loose pieces: a skirt's middle is shared by both legs by way of the trunk, from where it is neither's",
          "[applications][weights]") {
    const Eigen::Vector3d left = joint("left_knee").position, right = joint("right_knee").position;
    const TriangleMesh<double> cloth = skirt((left + right) / 2, (left - right).norm() / 2 + 0.15);
    const Skin<double> skin = skin_with(cloth);
    const Eigen::Index first = test::sample_body().mesh.vertices.rows();
    double jump = 0, most[2] = {};
    for (Eigen::Index v = 0; v < cloth.vertices.rows(); ++v) {
        CHECK(test::limbs_followed(skin, first + v, human(), 0.01) <= 1);
        for (const Side side : {Side::left, Side::right}) {
            double& of_side = most[side == Side::left ? 0 : 1];
            of_side = std::max(of_side, followed(skin, first + v, BodyPart::leg, side));
        }
    }
    for (Eigen::Index f = 0; f < cloth.faces.rows(); ++f)
        for (const Side side : {Side::left, Side::right})
            jump = std::max(jump, std::abs(followed(skin, first + cloth.faces(f, 0), BodyPart::leg, side) -
                                           followed(skin, first + cloth.faces(f, 1), BodyPart::leg, side)));
    CHECK(most[0] > 0.5);
    CHECK(most[1] > 0.5);
    CHECK(jump < 0.33); // 1 where each vertex follows the leg that is nearer
}

TEST_CASE("loose pieces: none, and nothing changes", "[applications][weights]") {
    const test::SampleBody& sample = test::sample_body();
    JointWeights weights = JointWeights::Zero(sample.mesh.vertices.rows(), 21);
    weights.col(3).setOnes();
    const std::vector<double> gaps(static_cast<std::size_t>(weights.rows()), 0.0);
    CHECK(with_loose_pieces(weights, sample.mesh, sample.body, gaps, sample.skeleton, human()) == weights);
}

} // namespace
