#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include <Eigen/Geometry>

#include <skelgen/applications/impl/heat_weights.hpp>
#include <skelgen/applications/impl/resting_surface.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/core/skeleton_template.hpp>

namespace skelgen::applications {

namespace detail {

/// How much the weights of an edge's ends may differ: of what follows a joint and those below it.
template <typename Scalar>
class StretchBound {
    using Accumulator = core::Accumulator;

public:
    StretchBound(const RestingSurface<Scalar>& surface, const SkeletonTemplate& skeleton_template,
                 const TriangleMesh<Scalar>& rest)
        : skeleton_(surface.skeleton), template_(skeleton_template),
          shortest_(std::sqrt(core::surface_area(rest)) / 1000) {
        Eigen::AlignedBox<Scalar, 3> box;
        for (Eigen::Index v = 0; v < rest.vertices.rows(); ++v) box.extend(core::point(rest.vertices, v));
        for (const Joint<Scalar>& joint : skeleton_.joints) box.extend(joint.position);
        farthest_ = 2 * box.diagonal().norm(); // vertices move a little with their weights
        for (const Eigen::Quaternion<Scalar>& axes : surface.axes) {
            const Eigen::AngleAxis<Scalar> bend(Scalar(std::numbers::pi / 2), axes * Vector3<Scalar>::UnitX());
            moved_by_bend_.push_back(bend.toRotationMatrix() - Eigen::Matrix3<Scalar>::Identity());
        }
    }

    /// The part of their difference that the rows of an edge's ends may keep: 1 where it is not stretched too far.
    [[nodiscard]] Accumulator kept(const JointWeights& weights, const Points<Scalar>& rest, int a, int b) const {
        const Vector3<Scalar> from = core::point(rest, a), to = core::point(rest, b), middle = (from + to) / 2;
        const Scalar length = std::max(shortest_, (to - from).norm());
        const auto may_grow = static_cast<Accumulator>((most - 1) * length);
        const auto harmless = // whatever the joint
            static_cast<Accumulator>((most_at_hinge - 1) * length / moved(farthest_));
        if ((weights.row(a) - weights.row(b)).cwiseAbs().sum() < harmless) return 1;
        // Of each end, then also what follows the joints below a joint.
        Eigen::RowVectorX<Accumulator> one = weights.row(a), other = weights.row(b);
        Accumulator part = 1;
        for (Eigen::Index j = one.size(); j-- > 1;) {
            const TemplateJoint& joint = template_.joints[static_cast<std::size_t>(j)];
            const Accumulator difference = std::abs(one[j] - other[j]);
            if (part_of(joint.role) != BodyPart::trunk && difference >= harmless) {
                const Vector3<Scalar>& place = skeleton_.joints[static_cast<std::size_t>(j)].position;
                part = std::min(part, may_grow / static_cast<Accumulator>(moved((middle - place).norm())) / difference);
                if (joint.role == JointRole::elbow || joint.role == JointRole::knee)
                    part = std::min(part, kept_at_hinge(from - place, to - place, one[j], other[j],
                                                        moved_by_bend_[static_cast<std::size_t>(j)]));
            }
            one[joint.parent] += one[j];
            other[joint.parent] += other[j];
        }
        return part;
    }

private:
    // How many times its length an edge may have. Working values: on 16 research bodies volumes change as little
    // with 1.75.
    static constexpr auto most = Scalar(3), most_at_hinge = Scalar(1.9);

    /// The same of a joint that bends one way: by where that takes the ends, `from` and `to` of the joint.
    [[nodiscard]] Accumulator kept_at_hinge(const Vector3<Scalar>& from, const Vector3<Scalar>& to, Accumulator of_from,
                                            Accumulator of_to, const Eigen::Matrix3<Scalar>& bend) const {
        const Vector3<Scalar> edge = to - from;
        const Scalar longest = most_at_hinge * std::max(shortest_, edge.norm());
        // Bent, with the ends' mean share and with their own: between the two its length is at most in between.
        const Vector3<Scalar> evenly = edge + Scalar((of_from + of_to) / 2) * (bend * edge);
        const Vector3<Scalar> bent = evenly - Scalar((of_from - of_to) / 2) * (bend * (from + to));
        const Scalar least = evenly.norm(), length = bent.norm(); // the first is no longer than the edge
        return length > longest ? static_cast<Accumulator>((longest - least) / (length - least)) : 1;
    }

    /// How far a bend by 90 degrees moves what is so far from the joint.
    static Scalar moved(Scalar distance) { return std::numbers::sqrt2_v<Scalar> * distance; }

    const KinematicSkeleton<Scalar>& skeleton_;
    const SkeletonTemplate& template_;
    Scalar shortest_;                                   ///< what a shorter edge counts as
    Scalar farthest_;                                   ///< no vertex is so far from a joint
    std::vector<Eigen::Matrix3<Scalar>> moved_by_bend_; ///< per joint: takes a place, seen from it, to how it is moved
};

/// The limb that a vertex follows most, -1 where it follows none.
inline int strongest_limb(const JointWeights& weights, Eigen::Index v, const std::vector<int>& limb_of_joint) {
    int limb = -1;
    core::Accumulator most = 0;
    for (Eigen::Index j = 0; j < weights.cols(); ++j) {
        const int of_joint = limb_of_joint[static_cast<std::size_t>(j)];
        if (of_joint < 0 || !(weights(v, j) > most)) continue;
        most = weights(v, j);
        limb = of_joint;
    }
    return limb;
}

/// The edges between vertices of the same limb, once each.
inline std::vector<std::array<int, 2>> edges_of_limbs(const Triangles& faces, const std::vector<int>& limb) {
    std::vector<std::array<int, 2>> edges;
    for (Eigen::Index f = 0; f < faces.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int a = faces(f, k), b = faces(f, (k + 1) % 3);
            if (limb[static_cast<std::size_t>(a)] == limb[static_cast<std::size_t>(b)])
                edges.push_back({std::min(a, b), std::max(a, b)});
        }
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    return edges;
}

} // namespace detail

/// The weights with no edge that grows to more than 1.9 times its length when elbows and knees bend by 90 degrees from
/// rest, nor to more than three times when any joint of a limb bends so, by linear skinning: where it would, the
/// weights of its ends come nearer to each other, in rounds over the edges whose ends the last one changed, and so
/// moved at rest; nothing else changes. Edges between two limbs stay. Edges shorter than a thousandth of the square
/// root of the area count as that long. `faces` name the weights' rows, `limb_of_joint` as `LimbRegions::of_joint`.
/// O(rounds faces + joints).
template <typename Scalar>
JointWeights with_bounded_stretch(JointWeights weights, const RestingSurface<Scalar>& surface, const Triangles& faces,
                                  const SkeletonTemplate& skeleton_template, const std::vector<int>& limb_of_joint) {
    constexpr int rounds = 100;
    std::vector<int> limb;
    for (Eigen::Index v = 0; v < weights.rows(); ++v) limb.push_back(detail::strongest_limb(weights, v, limb_of_joint));
    const std::vector<std::array<int, 2>> edges = detail::edges_of_limbs(faces, limb);
    Points<Scalar> rest = at_rest(surface, weights);
    const detail::StretchBound<Scalar> bound(surface, skeleton_template, {rest, faces});
    // What edges want of a vertex is averaged by how much they want it: neither their order nor rounding that has one
    // of them want something says much.
    std::vector<int> last(limb.size(), 0), changed; // `last`: the round that changed each vertex, from 1
    Eigen::VectorX<core::Accumulator> wanted = Eigen::VectorX<core::Accumulator>::Zero(weights.rows());
    JointWeights changes = JointWeights::Zero(weights.rows(), weights.cols());
    for (int round = 1; round <= rounds; ++round) {
        changed.clear();
        const auto want = [&](int v, core::Accumulator much, const Eigen::RowVectorX<core::Accumulator>& change) {
            if (wanted[v] == 0) changed.push_back(v);
            wanted[v] += much;
            changes.row(v) += much * change;
        };
        for (const auto& [a, b] : edges) {
            if (last[static_cast<std::size_t>(a)] < round - 1 && last[static_cast<std::size_t>(b)] < round - 1)
                continue;
            const core::Accumulator part = bound.kept(weights, rest, a, b);
            if (!(part < 1)) continue;
            const Eigen::RowVectorX<core::Accumulator> nearer = (1 - part) / 2 * (weights.row(b) - weights.row(a));
            want(a, 1 - part, nearer);
            want(b, 1 - part, -nearer);
        }
        if (changed.empty()) break;
        for (const int v : changed) {
            weights.row(v) += changes.row(v) / wanted[v];
            changes.row(v).setZero();
            wanted[v] = 0;
            last[static_cast<std::size_t>(v)] = round;
        }
        rest(changed, Eigen::all) = at_rest(surface, weights, changed);
    }
    return weights;
}

} // namespace skelgen::applications
