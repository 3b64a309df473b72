#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include <skelgen/applications/bone_orientations.hpp>
#include <skelgen/applications/impl/bones.hpp>
#include <skelgen/applications/impl/kept_volumes.hpp>
#include <skelgen/applications/impl/limb_volume.hpp>

#include "catch.hpp"
#include "human.hpp"
#include "mesh_changes.hpp"
#include "shapes.hpp"
#include "sleeve.hpp"

namespace {

using namespace skelgen;
using namespace skelgen::applications;
using test::human;
using test::sleeve_radius;

KinematicSkeleton<double> arm_at_rest() {
    auto rest = rest_skeleton<double>(human());
    rest.joints[static_cast<std::size_t>(find_joint(rest, "left_elbow"))].radius = sleeve_radius;
    return rest;
}

/// What a bend of the left elbow by 90 degrees changes of the forearm's volume, as a share.
double change(const TriangleMesh<double>& straight, const JointWeights& weights,
              const KinematicSkeleton<double>& rest) {
    const int elbow = find_joint(rest, "left_elbow");
    const auto place = [&](const char* name) {
        return rest.joints[static_cast<std::size_t>(find_joint(rest, name))].position;
    };
    std::vector<RigidMotion<double>> motions(rest.joints.size());
    const Eigen::Matrix3d axes = rest_axes<double>(human())[static_cast<std::size_t>(elbow)].toRotationMatrix();
    for (std::size_t j = 0; j < motions.size(); ++j) {
        if (!joints_below(human(), elbow)[j]) continue;
        motions[j].rotation = Eigen::AngleAxisd(std::numbers::pi / 2, axes.col(0));
        motions[j].translation = place("left_elbow") - motions[j].rotation * place("left_elbow");
    }
    const Skin<double> skin = strongest_influences<double>(weights);
    std::vector<int> strongest;
    for (Eigen::Index v = 0; v < weights.rows(); ++v) strongest.push_back(skin.joints(v, 0));
    const Triangles part = around_bone(straight.vertices, faces_following(straight.faces, strongest, elbow),
                                       place("left_elbow"), place("left_wrist"));
    return std::abs(closed_volume(skinned_linearly(straight.vertices, skin, motions), part) /
                        closed_volume(straight.vertices, part) -
                    1);
}

JointWeights as_they_are(JointWeights weights) { return weights; }

JointWeights kept(const TriangleMesh<double>& mesh, const JointWeights& weights, const KinematicSkeleton<double>& rest,
                  const std::function<JointWeights(JointWeights)>& restricted = as_they_are) {
    const std::vector<RigidMotion<double>> none(rest.joints.size());
    return with_kept_volumes<double>(weights, {mesh.vertices, none, rest, human_axes()}, mesh.faces, human(),
                                     restricted);
}

TEST_CASE("kept volumes: limbs of few rings keep their volume, and those that do stay as they are",
          "[applications][weights]") {
    const auto rest = arm_at_rest();
    int changed = 0;
    for (const double steepness : {4 / sleeve_radius, 6 / sleeve_radius})
        for (int offset = 0; offset < 4; ++offset)
            for (int border = -3; border <= 3; ++border) {
                const TriangleMesh<double> mesh = test::prism(rest, offset * sleeve_radius / 4);
                const JointWeights before =
                    test::sleeve_weights(mesh.vertices, rest, border * sleeve_radius / 5, steepness);
                const JointWeights after = kept(mesh, before, rest);
                const double was = change(mesh, before, rest);
                CAPTURE(steepness, offset, border, was);
                CHECK((after.rowwise().sum().array() - 1).abs().maxCoeff() < 1e-12);
                CHECK(change(mesh, after, rest) < 0.05);
                if (was < 0.05)
                    CHECK(after == before);
                else
                    ++changed;
            }
    CHECK(changed > 2);
}

/// A limb that loses 7 % of its volume.
struct Lossy {
    KinematicSkeleton<double> rest = arm_at_rest();
    TriangleMesh<double> mesh = test::prism(rest, sleeve_radius / 2);
    JointWeights weights = test::sleeve_weights(mesh.vertices, rest, -0.6 * sleeve_radius, 6 / sleeve_radius);
};

TEST_CASE("kept volumes: pieces that lie on each other stay together", "[applications][weights]") {
    const Lossy limb;
    const TriangleMesh<double> twice = test::side_by_side(limb.mesh, limb.mesh);
    JointWeights before(twice.vertices.rows(), limb.weights.cols());
    before << limb.weights, limb.weights;
    const JointWeights after = kept(twice, before, limb.rest);
    CHECK(change(twice, before, limb.rest) > 0.05);
    CHECK(change(twice, after, limb.rest) < 0.05);
    CHECK(after.topRows(limb.weights.rows()) == after.bottomRows(limb.weights.rows()));
}

TEST_CASE("kept volumes: what lies far off and hardly follows a hinge does not come to follow it",
          "[applications][weights]") {
    const Lossy limb;
    const int elbow = find_joint(limb.rest, "left_elbow"), shoulder = find_joint(limb.rest, "left_shoulder");
    const Eigen::Vector3d place = limb.rest.joints[static_cast<std::size_t>(elbow)].position;
    for (const double side : {-1.0, 1.0}) {
        TriangleMesh<double> wing = test::sphere(sleeve_radius, 1);
        wing.vertices.rowwise() += (place + side * 10 * sleeve_radius * Eigen::Vector3d::UnitZ()).transpose();
        const TriangleMesh<double> mesh = test::side_by_side(limb.mesh, wing);
        JointWeights before = JointWeights::Zero(mesh.vertices.rows(), limb.weights.cols());
        before.topRows(limb.weights.rows()) = limb.weights;
        before.bottomRows(wing.vertices.rows()).col(elbow).setConstant(1e-4);
        before.bottomRows(wing.vertices.rows()).col(shoulder).setConstant(1 - 1e-4);
        const JointWeights after = kept(mesh, before, limb.rest);
        CHECK(change(mesh, after, limb.rest) < 0.05);
        CHECK(after.bottomRows(wing.vertices.rows()).col(elbow).maxCoeff() < 0.05);
    }
}

TEST_CASE("kept volumes: a limb that comes bent keeps the volume that it has at rest", "[applications][weights]") {
    const Lossy limb;
    const auto elbow = static_cast<std::size_t>(find_joint(limb.rest, "left_elbow"));
    const std::vector<RigidMotion<double>> motions = test::bent_sleeve(limb.rest, 1).motions;
    std::vector<RigidMotion<double>> bending = motions;
    for (std::size_t j = 0; j < bending.size(); ++j) {
        if (!joints_below(human(), static_cast<int>(elbow))[j]) continue;
        bending[j].rotation = motions[j].rotation.conjugate();
        bending[j].translation = -(bending[j].rotation * motions[j].translation);
    }
    const Points<double> bent = skinned(limb.mesh.vertices, strongest_influences<double>(limb.weights), bending);
    const RestingSurface<double> surface{bent, motions, limb.rest, human_axes()};
    const auto at_rest_with = [&](const JointWeights& weights) {
        return TriangleMesh<double>{at_rest(surface, weights), limb.mesh.faces};
    };
    CHECK(change(at_rest_with(limb.weights), limb.weights, limb.rest) > 0.05);
    const JointWeights after = with_kept_volumes<double>(limb.weights, surface, limb.mesh.faces, human(), as_they_are);
    CHECK(change(at_rest_with(after), after, limb.rest) < 0.05);
}

TEST_CASE("kept volumes: what is tried is judged as it has been restricted", "[applications][weights]") {
    const Lossy limb;
    int tries = 0;
    const auto undone = [&](const JointWeights&) {
        ++tries;
        return limb.weights;
    };
    CHECK(kept(limb.mesh, limb.weights, limb.rest, undone) == limb.weights);
    CHECK(tries > 0);
    CHECK(tries <= 20);
}

TEST_CASE("kept volumes: what follows one joint alone stays", "[applications][weights]") {
    const Lossy limb;
    JointWeights weights = JointWeights::Zero(limb.weights.rows(), limb.weights.cols());
    weights.col(find_joint(limb.rest, "left_elbow")).setOnes();
    CHECK(kept(limb.mesh, weights, limb.rest) == weights);
}

} // namespace
