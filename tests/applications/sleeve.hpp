#pragma once

// A limb whose bends are known in closed form.

#include <cmath>
#include <numbers>
#include <vector>

#include <skelgen/applications/bone_orientations.hpp>
#include <skelgen/applications/impl/bones.hpp>
#include <skelgen/applications/impl/heat_weights.hpp>
#include <skelgen/applications/skinning.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/core/shortest_turn.hpp>

#include "human.hpp"
#include "shapes.hpp"

namespace skelgen::test {

inline constexpr double sleeve_radius = 0.04;

/// A tube around the left arm of the template, from the middle of the upper arm to that of the forearm.
inline TriangleMesh<double> sleeve(const KinematicSkeleton<double>& rest) {
    const auto at = [&](const char* name) {
        return rest.joints[static_cast<std::size_t>(find_joint(rest, name))].position;
    };
    const Eigen::Vector3d from = (at("left_shoulder") + at("left_elbow")) / 2,
                          to = (at("left_elbow") + at("left_wrist")) / 2;
    TriangleMesh<double> tube = capsule(sleeve_radius, (to - from).norm());
    const Eigen::Quaterniond turn = core::shortest_turn<double>(Eigen::Vector3d::UnitZ(), to - from);
    for (Eigen::Index v = 0; v < tube.vertices.rows(); ++v)
        tube.vertices.row(v) = (from + turn * tube.vertices.row(v).transpose()).transpose();
    return tube;
}

/// A prism around the left arm of the template as characters for games have them: eight vertices to a ring, rings a
/// radius apart, those at the elbow so far beyond it. Closed, of the sleeve's length.
inline TriangleMesh<double> prism(const KinematicSkeleton<double>& rest, double offset) {
    constexpr int around = 8;
    const auto at = [&](const char* name) {
        return rest.joints[static_cast<std::size_t>(find_joint(rest, name))].position;
    };
    const Eigen::Vector3d elbow = at("left_elbow"), along = (at("left_wrist") - elbow).normalized();
    const int before = static_cast<int>((elbow - at("left_shoulder")).norm() / sleeve_radius / 2),
              after = static_cast<int>((at("left_wrist") - elbow).norm() / sleeve_radius / 2);
    const int rings = before + after + 1, ends = rings * around;
    TriangleMesh<double> out{Points<double>(ends + 2, 3), Triangles(2 * ends, 3)};
    const auto middle = [&](int ring) { return elbow + (offset + sleeve_radius * (ring - before)) * along; };
    for (int v = 0; v < ends; ++v) {
        const double angle = std::numbers::pi / 4 * (v % around);
        const Eigen::Vector3d off(0, sleeve_radius * std::cos(angle), sleeve_radius * std::sin(angle));
        out.vertices.row(v) =
            (middle(v / around) + core::shortest_turn<double>(Eigen::Vector3d::UnitX(), along) * off).transpose();
    }
    out.vertices.row(ends) = middle(0).transpose();
    out.vertices.row(ends + 1) = middle(rings - 1).transpose();
    Eigen::Index f = 0;
    for (int k = 0; k < around; ++k) {
        const int next = (k + 1) % around, last = ends - around;
        out.faces.row(f++) << ends, next, k;
        for (int at_ring = 0; at_ring < last; at_ring += around) {
            out.faces.row(f++) << at_ring + k, at_ring + next, at_ring + around + next;
            out.faces.row(f++) << at_ring + k, at_ring + around + next, at_ring + around + k;
        }
        out.faces.row(f++) << ends + 1, last + k, last + next;
    }
    return out;
}

/// Weights of a sleeve along the straight arm, whose border lies so far beyond the elbow; `steepness` of the odds'
/// logarithm along the arm.
inline applications::JointWeights sleeve_weights(const Points<double>& straight, const KinematicSkeleton<double>& rest,
                                                 double border, double steepness) {
    const int shoulder = find_joint(rest, "left_shoulder"), elbow = find_joint(rest, "left_elbow");
    const double joint = rest.joints[static_cast<std::size_t>(elbow)].position.x();
    applications::JointWeights weights =
        applications::JointWeights::Zero(straight.rows(), static_cast<Eigen::Index>(rest.joints.size()));
    for (Eigen::Index v = 0; v < weights.rows(); ++v) {
        weights(v, elbow) = 1 / (1 + std::exp(-steepness * (straight(v, 0) - joint - border)));
        weights(v, shoulder) = 1 - weights(v, elbow);
    }
    return weights;
}

/// A sleeve that comes bent at the elbow, and what straightens it.
struct BentSleeve {
    TriangleMesh<double> mesh;
    std::vector<applications::RigidMotion<double>> motions;
};

inline BentSleeve bent_sleeve(const KinematicSkeleton<double>& rest, double angle) {
    using Motions = std::vector<applications::RigidMotion<double>>;
    const auto elbow = static_cast<std::size_t>(find_joint(rest, "left_elbow"));
    const Eigen::Vector3d joint = rest.joints[elbow].position;
    const Eigen::Vector3d axis = applications::rest_axes<double>(human())[elbow] * Eigen::Vector3d::UnitX();
    BentSleeve out{sleeve(rest), Motions(rest.joints.size())};
    Motions bending(rest.joints.size());
    for (std::size_t j = 0; j < bending.size(); ++j) {
        if (!applications::joints_below(human(), static_cast<int>(elbow))[j]) continue;
        bending[j].rotation = Eigen::AngleAxisd(angle, axis);
        out.motions[j].rotation = bending[j].rotation.conjugate();
        bending[j].translation = joint - bending[j].rotation * joint;
        out.motions[j].translation = joint - out.motions[j].rotation * joint;
    }
    const auto weights = sleeve_weights(out.mesh.vertices, rest, 0, 12 / sleeve_radius);
    out.mesh.vertices =
        applications::skinned(out.mesh.vertices, applications::strongest_influences<double>(weights), bending);
    return out;
}

} // namespace skelgen::test
