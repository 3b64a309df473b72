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

template <typename Scalar>
KinematicSkeleton<Scalar> with_joints_at(const Points<Scalar>& places, KinematicSkeleton<Scalar> skeleton,
                                         const Body<Scalar>& body, const CurveSkeleton<Scalar>& curve,
                                         const SkeletonTemplate& skeleton_template) {
    for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
        Joint<Scalar>& joint = skeleton.joints[j];
        if (!joint.is_present) continue;
        const Vector3<Scalar> place = core::point(places, static_cast<Eigen::Index>(j)), shift = place - joint.position;
        joint.position = place;
        for (auto& [name, end] : skeleton.end_points)
            if (shift.norm() > 0 && name == end_point_name(skeleton_template, skeleton_template.joints[j]))
                end =
                    core::point(body.mesh.vertices, body.tree.nearest_corner(body.mesh, Vector3<Scalar>(end + shift)));
    }
    skeleton = equalise_bones(std::move(skeleton), skeleton_template).skeleton;
    skeleton = measure_radii(move_inside(std::move(skeleton), body, curve).skeleton, body);
    skeleton.frame.origin = skeleton.joints.front().position;
    return skeleton;
}

} // namespace skelgen::anatomy
