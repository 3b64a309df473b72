#pragma once

#include <skelgen/applications/bounded_stretch.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include <skelgen/core/geometry.hpp>

namespace skelgen::applications {
namespace detail {

/// How much the weights of an edge's ends may differ: of what follows a joint and those below it.
template <typename Scalar>
class StretchBound {
public:
    StretchBound(const HeldSurface<Scalar>& pose, const Triangles& faces, const SkeletonTemplate& skeleton_template)
        : pose_(pose), template_(skeleton_template),
          shortest_(std::sqrt(core::surface_area(TriangleMesh<Scalar>{pose.vertices, faces})) / 1000) {}

    /// The part of their difference that the rows of an edge's ends may keep: 1 where it is not stretched too far.
    [[nodiscard]] core::Accumulator kept(const JointWeights& weights, int a, int b) const {
        using core::Accumulator;
        Eigen::RowVectorX<Accumulator> below = weights.row(a) - weights.row(b); // then also of those below a joint
        Accumulator part = 1;
        for (Eigen::Index j = below.size(); j-- > 1;) {
            const TemplateJoint& joint = template_.joints[static_cast<std::size_t>(j)];
            if (part_of(joint.role) != BodyPart::trunk) part = std::min(part, largest(a, b, j) / std::abs(below[j]));
            below[joint.parent] += below[j];
        }
        return part;
    }

private:
    /// A bend by 90 degrees moves what follows it by the square root of two times its distance from the joint.
    [[nodiscard]] core::Accumulator largest(int a, int b, Eigen::Index j) const {
        constexpr Scalar most = 3; // times its length
        const Vector3<Scalar> from = core::point(pose_.vertices, a), to = core::point(pose_.vertices, b);
        const Vector3<Scalar>& joint = pose_.skeleton.joints[static_cast<std::size_t>(j)].position;
        const Scalar moved = std::numbers::sqrt2_v<Scalar> * ((from + to) / 2 - joint).norm();
        return static_cast<core::Accumulator>((most - 1) * std::max(shortest_, (to - from).norm()) / moved);
    }

    const HeldSurface<Scalar>& pose_;
    const SkeletonTemplate& template_;
    Scalar shortest_; ///< what a shorter edge counts as
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

} // namespace detail

template <typename Scalar>
JointWeights with_bounded_stretch(JointWeights weights, const HeldSurface<Scalar>& pose, const Triangles& faces,
                                  const SkeletonTemplate& skeleton_template, const std::vector<int>& limb_of_joint) {
    constexpr int rounds = 20;
    const detail::StretchBound<Scalar> bound(pose, faces, skeleton_template);
    std::vector<int> limb;
    for (Eigen::Index v = 0; v < weights.rows(); ++v) limb.push_back(detail::strongest_limb(weights, v, limb_of_joint));
    std::vector<int> changed(limb.size(), 0); ///< the round before which each vertex was last changed
    bool any = true;
    for (int round = 0; round < rounds && any; ++round) {
        any = false;
        for (Eigen::Index f = 0; f < faces.rows(); ++f)
            for (int k = 0; k < 3; ++k) {
                const int a = faces(f, k), b = faces(f, (k + 1) % 3);
                const auto at_a = static_cast<std::size_t>(a), at_b = static_cast<std::size_t>(b);
                if (a > b || limb[at_a] != limb[at_b]) continue;
                if (changed[at_a] < round && changed[at_b] < round) continue; // it was seen to be fine
                const core::Accumulator part = bound.kept(weights, a, b);
                if (!(part < 1)) continue;
                any = true;
                changed[at_a] = changed[at_b] = round + 1;
                const Eigen::RowVectorX<core::Accumulator> middle = (weights.row(a) + weights.row(b)) / 2;
                const Eigen::RowVectorX<core::Accumulator> off = part * (weights.row(a) - middle);
                weights.row(a) = middle + off;
                weights.row(b) = middle - off;
            }
    }
    return weights;
}

} // namespace skelgen::applications
