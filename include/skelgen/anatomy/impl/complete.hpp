#pragma once

#include <skelgen/anatomy/complete.hpp>

#include <string>
#include <utility>

#include <skelgen/anatomy/equal_bones.hpp>
#include <skelgen/anatomy/inside.hpp>
#include <skelgen/anatomy/joint_offsets.hpp>
#include <skelgen/anatomy/radii.hpp>

namespace skelgen::anatomy {

template <typename Scalar>
Outcome<JudgedSkeleton<Scalar>> complete_skeleton(KinematicSkeleton<Scalar> sided, const Body<Scalar>& body,
                                                  const CurveSkeleton<Scalar>& curve,
                                                  const SkeletonTemplate& skeleton_template) {
    constexpr int one_in = 5; // a working value, not a measured one
    KinematicSkeleton<Scalar> skeleton = apply_joint_offsets(std::move(sided), skeleton_template);
    EqualBones<Scalar> equal = equalise_bones(std::move(skeleton), skeleton_template);
    Outcome<MovedInside<Scalar>> inside = move_inside(std::move(equal.skeleton), body, curve);
    if (!inside) return inside.failure();
    skeleton = measure_radii(std::move(inside->skeleton), body);
    skeleton.frame.origin = skeleton.joints.front().position;
    JudgedSkeleton<Scalar> out =
        estimate_confidence(std::move(skeleton), skeleton_template, equal.measured, inside->moved);
    if (one_in * out.misplaced > static_cast<int>(out.skeleton.joints.size()))
        return Failure{FailureReason::no_match, "no human body: " + std::to_string(out.misplaced) +
                                                    " joints of its skeleton would have bones of unlikely lengths"};
    return out;
}

} // namespace skelgen::anatomy
