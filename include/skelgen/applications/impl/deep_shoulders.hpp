#pragma once

#include <skelgen/applications/deep_shoulders.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <skelgen/applications/bones.hpp>
#include <skelgen/applications/joint_weights.hpp>
#include <skelgen/core/geometry.hpp>

namespace skelgen::applications {
namespace detail {

/// How much more likely the arm moves a place, as a logarithm, by where it is along the upper arm: 0 at the elbow, 1 at
/// the shoulder.
template <typename Scalar>
core::Accumulator log_odds_beside_arm(Scalar along) {
    constexpr core::Accumulator most = 2, from = 0.4, full = 0.7;
    const core::Accumulator t = std::clamp((static_cast<core::Accumulator>(along) - from) / (full - from),
                                           core::Accumulator(0), core::Accumulator(1));
    return most * t * t * (3 - 2 * t);
}

} // namespace detail

template <typename Scalar>
JointWeights with_deep_shoulders(JointWeights weights, const Points<Scalar>& vertices,
                                 const KinematicSkeleton<Scalar>& skeleton, const SkeletonTemplate& skeleton_template) {
    for (int j = 0; j < static_cast<int>(skeleton_template.joints.size()); ++j) {
        if (skeleton_template.joint(j).role != JointRole::shoulder) continue;
        const Vector3<Scalar> elbow = bone_end(skeleton, skeleton_template, j);
        const Vector3<Scalar> bone = skeleton.joints[static_cast<std::size_t>(j)].position - elbow;
        const std::vector<bool> is_below = joints_below(skeleton_template, j);
        for (Eigen::Index v = 0; v < weights.rows() && bone.squaredNorm() > 0; ++v) {
            const auto [below, above] = shares_of(weights, v, is_below);
            if (!(below > 0 && above > 0)) continue;
            const Scalar along = (core::point(vertices, v) - elbow).dot(bone) / bone.squaredNorm();
            const core::Accumulator less = std::exp(-detail::log_odds_beside_arm(along));
            divide_shares(weights, v, is_below, below / (below + less * above));
        }
    }
    return weights;
}

} // namespace skelgen::applications
