#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <skelgen/applications/bone_orientations.hpp>
#include <skelgen/applications/impl/balanced_bends.hpp>
#include <skelgen/applications/impl/bones.hpp>

#include "catch.hpp"
#include "human.hpp"
#include "mesh_changes.hpp"
#include "sleeve.hpp"

namespace {

using namespace skelgen;
using namespace skelgen::applications;
using test::human;

using test::BentSleeve;
using test::sleeve_radius;

constexpr double odds_steepness = 12 / sleeve_radius;

JointWeights weights_with_border(const Points<double>& vertices, const KinematicSkeleton<double>& rest, double border) {
    return test::sleeve_weights(vertices, rest, border, odds_steepness);
}

TEST_CASE("balanced bends: in the middle of a tube the border goes to the joint", "[applications][weights]") {
    const auto rest = rest_skeleton<double>(human());
    const TriangleMesh<double> tube = test::sleeve(rest);
    const int elbow = find_joint(rest, "left_elbow");
    const double joint = rest.joints[static_cast<std::size_t>(elbow)].position.x();
    const std::vector<RigidMotion<double>> none(rest.joints.size());
    for (const double border : {-0.3 * sleeve_radius, 0.0, 0.3 * sleeve_radius}) {
        const JointWeights before = weights_with_border(tube.vertices, rest, border);
        const JointWeights after =
            with_balanced_bends<double>(before, {tube.vertices, none, rest, human_axes()}, tube.faces, human());
        CHECK((after.rowwise().sum().array() - 1).abs().maxCoeff() < 1e-12);
        for (Eigen::Index v = 0; v < after.rows(); ++v) {
            const double share = after(v, elbow);
            if (share < 0.01 || share > 0.99) continue;
            const double is = tube.vertices(v, 0) - joint - std::log(share / (1 - share)) / odds_steepness;
            CHECK(std::abs(is) < 0.12 * sleeve_radius); // its two halves are not quite as long
        }
    }
}

/// What the parts of a sleeve on either side of its border gain when it bends by 90 degrees from rest, as squares of
/// their shares.
double changes(const BentSleeve& sleeve, const JointWeights& weights, const KinematicSkeleton<double>& rest) {
    const int elbow = find_joint(rest, "left_elbow");
    const Eigen::Vector3d joint = rest.joints[static_cast<std::size_t>(elbow)].position;
    const Eigen::Matrix3d bend(Eigen::AngleAxisd(
        std::numbers::pi / 2, rest_axes<double>(human())[static_cast<std::size_t>(elbow)] * Eigen::Vector3d::UnitX()));
    const Points<double> straight =
        at_rest<double>({sleeve.mesh.vertices, sleeve.motions, rest, human_axes()}, weights);
    double sum = 0;
    for (const bool is_below : {true, false}) {
        Eigen::Vector3d middle[2] = {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
        double volume[2] = {0, 0};
        std::vector<Eigen::Index> part;
        int rim = 0;
        const auto places = [&](int v) {
            const Eigen::Vector3d from = straight.row(v).transpose() - joint;
            const double share = weights(v, elbow);
            return std::array<Eigen::Vector3d, 2>{from, (1 - share) * from + share * (bend * from)};
        };
        const auto is_in = [&](int v) { return (weights(v, elbow) > 0.5) == is_below; };
        for (Eigen::Index f = 0; f < sleeve.mesh.faces.rows(); ++f) {
            int count = 0;
            for (int k = 0; k < 3; ++k) count += is_in(sleeve.mesh.faces(f, k)) ? 1 : 0;
            if (count == 3) part.push_back(f);
            if (count == 0 || count == 3) continue;
            for (int k = 0; k < 3; ++k) {
                if (!is_in(sleeve.mesh.faces(f, k))) continue;
                for (std::size_t i = 0; i < 2; ++i) middle[i] += places(sleeve.mesh.faces(f, k))[i];
                ++rim;
            }
        }
        for (const Eigen::Index f : part) {
            const auto a = places(sleeve.mesh.faces(f, 0)), b = places(sleeve.mesh.faces(f, 1)),
                       c = places(sleeve.mesh.faces(f, 2));
            for (std::size_t i = 0; i < 2; ++i) {
                const Eigen::Vector3d m = middle[i] / rim; // seen from there the lid has no volume
                volume[i] += (a[i] - m).dot((b[i] - m).cross(c[i] - m)) / 6;
            }
        }
        sum += std::pow(volume[1] / volume[0] - 1, 2);
    }
    return sum;
}

TEST_CASE("balanced bends: each border of a limb that comes bent is seen on the surface that it leads to",
          "[applications][weights]") {
    const auto rest = rest_skeleton<double>(human());
    const TriangleMesh<double> straight = test::sleeve(rest);
    for (const double angle : {1.0, 2.0}) {
        const BentSleeve sleeve = test::bent_sleeve(rest, angle);
        for (const double border : {-0.5 * sleeve_radius, 0.5 * sleeve_radius}) {
            const JointWeights before = test::sleeve_weights(straight.vertices, rest, border, 6 / sleeve_radius);
            const JointWeights after = with_balanced_bends<double>(
                before, {sleeve.mesh.vertices, sleeve.motions, rest, human_axes()}, sleeve.mesh.faces, human());
            CAPTURE(angle, border);
            CHECK(changes(sleeve, before, rest) > 0.001);
            CHECK(changes(sleeve, after, rest) < 0.0005); // seen on the surface that the weights led to before: 0.0007
        }
    }
}

TEST_CASE("balanced bends: borders stay where several pieces bend, and where little is lost",
          "[applications][weights]") {
    const auto rest = rest_skeleton<double>(human());
    const TriangleMesh<double> tube = test::sleeve(rest);
    const std::vector<RigidMotion<double>> none(rest.joints.size());
    const JointWeights before = weights_with_border(tube.vertices, rest, 0.3 * sleeve_radius);
    const auto moves = [&](const TriangleMesh<double>& mesh, const JointWeights& weights, double tolerated) {
        const auto after = with_balanced_bends<double>(weights, {mesh.vertices, none, rest, human_axes()}, mesh.faces,
                                                       human(), tolerated);
        return (after - weights).cwiseAbs().maxCoeff() > 0;
    };
    CHECK(moves(tube, before, 0));
    const RestingSurface<double> surface{tube.vertices, none, rest, human_axes()};
    const auto change = [&](const JointWeights& weights) {
        return largest_bend_change<double>(weights, surface, tube.faces, human());
    };
    CHECK(change(with_balanced_bends<double>(before, surface, tube.faces, human())) < change(before));
    CHECK_FALSE(moves(tube, before, 1));
    const TriangleMesh<double> twice = test::side_by_side(tube, tube);
    JointWeights of_both(twice.vertices.rows(), before.cols());
    of_both << before, before;
    CHECK_FALSE(moves(twice, of_both, 0));
}

TEST_CASE("balanced bends: what follows one joint alone stays", "[applications][weights]") {
    const auto rest = rest_skeleton<double>(human());
    const TriangleMesh<double> tube = test::sleeve(rest);
    JointWeights weights = JointWeights::Zero(tube.vertices.rows(), static_cast<Eigen::Index>(rest.joints.size()));
    weights.col(find_joint(rest, "left_elbow")).setOnes();
    const std::vector<RigidMotion<double>> none(rest.joints.size());
    CHECK(with_balanced_bends<double>(weights, {tube.vertices, none, rest, human_axes()}, tube.faces, human()) ==
          weights);
}

} // namespace
