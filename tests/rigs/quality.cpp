#include "quality.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include <nanoflann.hpp>

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

/// The faces of a welded mesh whose corners follow a joint most.
Triangles faces_following(const Triangles& faces, const applications::Skin<double>& skin, std::size_t joint) {
    Triangles out(faces.rows(), 3);
    Eigen::Index kept = 0;
    for (Eigen::Index f = 0; f < faces.rows(); ++f) {
        const auto follows = [&](int k) { return at(skin.joints(faces(f, k), 0)) == joint; };
        if (follows(0) && follows(1) && follows(2)) out.row(kept++) = faces.row(f);
    }
    out.conservativeResize(kept, 3);
    return out;
}

/// How many times faces surround a place: the solid angle under which it sees them, of all directions.
double winding_around(const Eigen::Vector3d& place, const Points<double>& vertices, const Triangles& faces,
                      const std::vector<int>& which) {
    double sum = 0;
    for (const int f : which) {
        Eigen::Vector3d corners[3];
        for (int k = 0; k < 3; ++k) corners[k] = core::point(vertices, faces(f, k)) - place;
        const auto& [a, b, c] = corners;
        const double la = a.norm(), lb = b.norm(), lc = c.norm();
        sum += 2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
    }
    return sum / (4 * std::numbers::pi);
}

/// Of the connected pieces of a part of a surface the one that surrounds a joint's bone most: a limb's own skin, or the
/// sleeve that stands for it. Half a skirt and a shield follow bones, too, but what they hold with their rims closed is
/// no volume of a limb.
Triangles around_bone(const Points<double>& vertices, const Triangles& part,
                      const applications::RigJoint<double>& bone) {
    core::DisjointSets sets(at(vertices.rows()));
    for (Eigen::Index f = 0; f < part.rows(); ++f)
        for (int k = 0; k < 2; ++k) sets.unite(at(part(f, k)), at(part(f, k + 1)));
    std::map<std::size_t, std::vector<int>> pieces;
    for (int f = 0; f < part.rows(); ++f) pieces[sets.find(at(part(f, 0)))].push_back(f);
    std::vector<int> best;
    double most = 0;
    for (const auto& [unused, faces] : pieces) {
        double winding = 0;
        for (const double along : {0.25, 0.5, 0.75})
            winding += winding_around(bone.position + along * (bone.end - bone.position), vertices, part, faces);
        if (!(std::abs(winding) > most)) continue; // scans may be inside out
        most = std::abs(winding);
        best = faces;
    }
    return part(best, Eigen::all);
}

/// Volume of a part of a surface, each rim of which is closed by a fan around its middle. Edges count as often as faces
/// run along them one way more than the other: where sheets meet in an edge, or faces lie twice, all is closed, too,
/// and what moves rigidly keeps its volume.
double closed_volume(const Points<double>& vertices, const Triangles& part) {
    std::map<std::pair<int, int>, int> rim; // per edge, its smaller end first, how often it is run along
    for (Eigen::Index f = 0; f < part.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int a = part(f, k), b = part(f, (k + 1) % 3);
            rim[std::minmax(a, b)] += a < b ? 1 : -1;
        }
    std::erase_if(rim, [](const auto& edge) { return edge.second == 0; });
    core::DisjointSets loops(at(vertices.rows()));
    for (const auto& [edge, times] : rim) loops.unite(at(edge.first), at(edge.second));
    std::map<std::size_t, std::pair<Eigen::Vector3d, double>> sums;
    for (const auto& [edge, times] : rim) {
        auto& [sum, length] = sums.try_emplace(loops.find(at(edge.first)), Eigen::Vector3d::Zero(), 0.0).first->second;
        const double weight = std::abs(times) * (vertices.row(edge.first) - vertices.row(edge.second)).norm();
        sum += weight / 2 * (vertices.row(edge.first) + vertices.row(edge.second)).transpose();
        length += weight;
    }
    double volume = core::enclosed_volume(TriangleMesh<double>{vertices, part});
    for (const auto& [edge, times] : rim) {
        const auto& [sum, length] = sums.at(loops.find(at(edge.first)));
        if (length > 0)
            volume += times *
                      core::point(vertices, edge.second).dot(core::point(vertices, edge.first).cross(sum / length)) / 6;
    }
    return volume;
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

    for (std::size_t j = 0; j < rig.joints.size(); ++j) {
        if (rig.joints[j].role != JointRole::elbow && rig.joints[j].role != JointRole::knee) continue;
        const Triangles part =
            around_bone(welded.mesh.vertices, faces_following(welded.mesh.faces, skin, j), rig.joints[j]);
        const double was = closed_volume(welded.mesh.vertices, part), is = closed_volume(welded_after, part);
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
