#pragma once

#include <skelgen/anatomy/complete.hpp>

#include <utility>
#include <vector>

#include <skelgen/anatomy/confidence.hpp>
#include <skelgen/anatomy/impl/equal_bones.hpp>
#include <skelgen/anatomy/impl/inside.hpp>
#include <skelgen/anatomy/impl/joint_offsets.hpp>
#include <skelgen/anatomy/impl/radii.hpp>

namespace skelgen::anatomy {

template <typename Scalar>
CompletedSkeleton<Scalar> complete_skeleton(KinematicSkeleton<Scalar> sided, const Body<Scalar>& body,
                                            const CurveSkeleton<Scalar>& curve,
                                            const SkeletonTemplate& skeleton_template) {
    KinematicSkeleton<Scalar> skeleton = apply_joint_offsets(std::move(sided), skeleton_template);
    EqualBones<Scalar> equal = equalise_bones(std::move(skeleton), skeleton_template);
    MovedInside<Scalar> inside = move_inside(std::move(equal.skeleton), body, curve);
    skeleton = measure_radii(std::move(inside.skeleton), body);
    skeleton.frame.origin = skeleton.joints.front().position;
    std::vector<double> doubt = joint_doubts(skeleton, skeleton_template, equal.measured);
    return {std::move(skeleton), std::move(doubt), std::move(inside.moved)};
}

} // namespace skelgen::anatomy
