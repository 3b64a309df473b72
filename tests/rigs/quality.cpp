#include "quality.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <nanoflann.hpp>

#include <skelgen/applications/impl/limb_volume.hpp>
#include <skelgen/core/builtin_templates.hpp>
#include <skelgen/core/disjoint_sets.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/surface/weld.hpp>

#include "applications/weights.hpp"

namespace skelgen::rigs {
namespace {

using applications::Rig;
using applications::RigidMotion;

std::size_t at(Eigen::Index i) { return static_cast<std::size_t>(i); }

/// What elbows and knees bent by 90 degrees do to each joint.
std::vector<RigidMotion<double>> bent(const Rig<double>& rig) {
    std::vector<RigidMotion<double>> out;
    for (const auto& joint : rig.joints) {
        const bool bends = joint.role == JointRole::elbow || joint.role == JointRole::knee;
        const Eigen::AngleAxisd own(bends ? std::numbers::pi / 2 : 0, joint.axes * Eigen::Vector3d::UnitX());
        const RigidMotion<double> parent = joint.parent < 0 ? RigidMotion<double>{} : out[at(joint.parent)];
        RigidMotion<double> motion;
        motion.rotation = parent.rotation * own;
        motion.translation = parent(joint.position) - motion.rotation * joint.position;
        out.push_back(motion);
    }
    return out;
}

/// Pairs of vertices of different pieces that lie within `reach` of each other, each vertex with the nearest other one.
std::vector<std::pair<int, int>> touching(const TriangleMesh<double>& mesh, double reach) {
    const auto welded = surface::weld(mesh, 0.0);
    const Points<double>& places = welded.mesh.vertices;
    core::DisjointSets pieces(static_cast<int>(places.rows()));
    for (Eigen::Index f = 0; f < welded.mesh.faces.rows(); ++f)
        for (int k = 0; k < 2; ++k) pieces.unite(welded.mesh.faces(f, k), welded.mesh.faces(f, k + 1));
    std::vector<int> first(at(places.rows()), -1);
    for (std::size_t v = 0; v < welded.placed.size(); ++v)
        if (welded.placed[v] >= 0) first[at(welded.placed[v])] = static_cast<int>(v);

    const nanoflann::KDTreeEigenMatrixAdaptor<Points<double>, 3, nanoflann::metric_L2_Simple> tree(3, places);
    std::vector<std::pair<int, int>> pairs;
    for (int v = 0; v < places.rows(); ++v) {
        std::vector<std::pair<Eigen::Index, double>> near;
        tree.index->radiusSearch(places.row(v).data(), reach * reach, near, nanoflann::SearchParams());
        for (const auto& [other, squared] : near)
            if (pieces.find(v) != pieces.find(static_cast<int>(other))) {
                pairs.emplace_back(first[at(v)], first[at(other)]);
                break; // they come in the order of their distances
            }
    }
    return pairs;
}

} // namespace

Quality measure(const Rig<double>& rig) {
    const SkeletonTemplate& human = builtin_template("human21");
    const Points<double>& before = rig.mesh.vertices;
    const std::vector<RigidMotion<double>> motions = bent(rig);
    const Points<double> after = applications::skinned_linearly(before, rig.skin, motions);
    const double height = before.col(1).maxCoeff() - before.col(1).minCoeff(), shortest = height / 1000;
    Quality quality;
    for (Eigen::Index v = 0; v < before.rows(); ++v) {
        quality.worst_sum = std::max(quality.worst_sum, std::abs(rig.skin.weights.row(v).sum() - 1));
        quality.two_limbs += test::limbs_followed(rig.skin, v, human, 0.01) > 1 ? 1 : 0;
    }
    quality.two_limbs /= static_cast<double>(before.rows());
    const auto welded = surface::weld(rig.mesh, 0.0);
    applications::Skin<double> skin = rig.skin; // of the welded vertices: seams have neighbours on both sides
    for (std::size_t v = 0; v < welded.placed.size(); ++v)
        if (welded.placed[v] >= 0)
            skin.joints.row(welded.placed[v]) = rig.skin.joints.row(static_cast<Eigen::Index>(v));
    skin.joints.conservativeResize(welded.mesh.vertices.rows(), Eigen::NoChange);
    quality.islands = test::islands(skin, welded.mesh.faces);
    Points<double> welded_after = welded.mesh.vertices;
    for (std::size_t v = 0; v < welded.placed.size(); ++v)
        if (welded.placed[v] >= 0) welded_after.row(welded.placed[v]) = after.row(static_cast<Eigen::Index>(v));

    for (Eigen::Index f = 0; f < rig.mesh.faces.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int a = rig.mesh.faces(f, k), b = rig.mesh.faces(f, (k + 1) % 3);
            const double length = std::max(shortest, (before.row(a) - before.row(b)).norm());
            const double ratio = (after.row(a) - after.row(b)).norm() / length;
            quality.stretch = std::max(quality.stretch, ratio);
            quality.overstretched += ratio > 3 ? 1 : 0;
        }
    quality.overstretched /= static_cast<double>(rig.mesh.faces.size());

    std::vector<int> strongest;
    for (Eigen::Index v = 0; v < skin.joints.rows(); ++v) strongest.push_back(skin.joints(v, 0));
    for (std::size_t j = 0; j < rig.joints.size(); ++j) {
        if (rig.joints[j].role != JointRole::elbow && rig.joints[j].role != JointRole::knee) continue;
        const Triangles following = applications::faces_following(welded.mesh.faces, strongest, static_cast<int>(j));
        const Triangles part =
            applications::around_bone(welded.mesh.vertices, following, rig.joints[j].position, rig.joints[j].end);
        const double was = applications::closed_volume(welded.mesh.vertices, part),
                     is = applications::closed_volume(welded_after, part);
        if (was != 0) quality.volume = std::max(quality.volume, std::abs(is / was - 1));
    }
    const auto limb_of = [&](int v) {
        const TemplateJoint& joint = human.joint(rig.skin.joints(v, 0));
        return std::pair(part_of(joint.role), joint.side);
    };
    for (const auto& [a, b] : touching(rig.mesh, 0.003 * height)) {
        const auto one = limb_of(a), other = limb_of(b);
        if (one != other && one.first != BodyPart::trunk && other.first != BodyPart::trunk) continue;
        const double growth = (after.row(a) - after.row(b)).norm() - (before.row(a) - before.row(b)).norm();
        quality.gap = std::max(quality.gap, growth / height);
    }
    return quality;
}

} // namespace skelgen::rigs
