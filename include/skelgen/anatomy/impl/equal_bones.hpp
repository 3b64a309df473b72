#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/core/skeleton_template.hpp>

namespace skelgen::anatomy {

/// A skeleton with like bones on both sides, and what it was made of.
template <typename Scalar = double>
struct EqualBones {
    KinematicSkeleton<Scalar> skeleton;
    std::vector<Scalar> measured; ///< bone_lengths() as they were before
};

namespace detail {

/// Makes the bone between two joints longer by that part of its length, half at each end.
template <typename Scalar>
void stretch(Vector3<Scalar>& a, Vector3<Scalar>& b, Scalar part) {
    const Vector3<Scalar> half = part / 2 * (b - a);
    a -= half;
    b += half;
}

} // namespace detail

/// Per joint the length of the bone from its parent; 0 for the root. O(joints).
template <typename Scalar>
std::vector<Scalar> bone_lengths(const KinematicSkeleton<Scalar>& skeleton) {
    std::vector<Scalar> lengths;
    for (const Joint<Scalar>& joint : skeleton.joints)
        lengths.push_back(
            joint.parent < 0
                ? Scalar(0)
                : (joint.position - skeleton.joints[static_cast<std::size_t>(joint.parent)].position).norm());
    return lengths;
}

/// The skeleton with the bones of both sides brought to like lengths, as they are in people: where a bone of a limb and
/// its counterpart differ by more than 4 % (and less than a third), their joints move along them, as little as that
/// takes (position-based dynamics, MHHR07). `skeleton` is in template order. O(joints^2).
template <typename Scalar>
EqualBones<Scalar> equalise_bones(KinematicSkeleton<Scalar> skeleton, const SkeletonTemplate& skeleton_template) {
    // Logarithms of ratios. People's two sides differ by one or two per cent, and so much again is the joints' error;
    // where one side is a third longer, one is plainly misplaced: averaging would spoil the other.
    constexpr auto largest_difference = static_cast<Scalar>(0.04), hopeless = static_cast<Scalar>(0.3);
    constexpr int rounds = 30; // the bones of a leg settle within ten
    const auto at = [&](int j) -> Vector3<Scalar>& { return skeleton.joints[static_cast<std::size_t>(j)].position; };
    const auto parent_of = [&](int j) { return skeleton.joints[static_cast<std::size_t>(j)].parent; };
    const auto is_present = [&](int j) { return skeleton.joints[static_cast<std::size_t>(j)].is_present; };
    std::vector<Scalar> measured = bone_lengths(skeleton);
    for (int round = 0; round < rounds; ++round)
        for (int left = 0; left < static_cast<int>(skeleton.joints.size()); ++left) {
            const int right = counterpart(skeleton_template, left);
            if (right < left) continue; // none, or seen from the other side
            if (!is_present(left) || !is_present(right)) continue;
            const int left_parent = parent_of(left), right_parent = parent_of(right);
            if (left_parent == right_parent) continue; // from the trunk: collar bones move
            const Scalar ratio = std::log((at(left) - at(left_parent)).norm() / (at(right) - at(right_parent)).norm());
            const Scalar excess = ratio - std::clamp(ratio, -largest_difference, largest_difference);
            if (!(std::abs(excess) > 0) || std::abs(ratio) > hopeless) continue;
            detail::stretch<Scalar>(at(left), at(left_parent), -excess / 2);
            detail::stretch<Scalar>(at(right), at(right_parent), excess / 2);
        }
    return {std::move(skeleton), std::move(measured)};
}

} // namespace skelgen::anatomy
