#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <skelgen/core/error.hpp>
#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/core/skeleton_template.hpp>

namespace skelgen::applications {

/// A line that moves with a joint: from the joint to one of its children or, of a joint that ends a limb, to the limb's
/// end on the surface.
template <typename Scalar = double>
struct Bone {
    int joint = -1;
    Vector3<Scalar> from = Vector3<Scalar>::Zero(), to = Vector3<Scalar>::Zero();
    Scalar radius_from = 0, radius_to = 0; ///< of the body around the bone's ends, same unit
};

/// Which joints a joint carries, itself among them. O(joints).
[[nodiscard]] inline std::vector<bool> joints_below(const SkeletonTemplate& skeleton_template, int joint) {
    std::vector<bool> is_below(skeleton_template.joints.size(), false);
    for (std::size_t j = 0; j < is_below.size(); ++j) {
        const int parent = skeleton_template.joints[j].parent;
        is_below[j] = static_cast<int>(j) == joint || (parent >= 0 && is_below[static_cast<std::size_t>(parent)]);
    }
    return is_below;
}

namespace detail {

template <typename Scalar>
void require_same_joints(const KinematicSkeleton<Scalar>& skeleton, const SkeletonTemplate& wanted) {
    bool same = skeleton.joints.size() == wanted.joints.size();
    for (std::size_t j = 0; same && j < wanted.joints.size(); ++j)
        same = skeleton.joints[j].name == wanted.joints[j].name && skeleton.joints[j].parent == wanted.joints[j].parent;
    if (!same) throw Error(ErrorCode::usage, "the skeleton's joints are not those of the template " + wanted.name);
}

template <typename Scalar>
std::optional<Vector3<Scalar>> end_point_of(const KinematicSkeleton<Scalar>& skeleton,
                                            const SkeletonTemplate& skeleton_template, int j) {
    const TemplateJoint& joint = skeleton_template.joint(j);
    if (!ends_limb(joint.role)) return std::nullopt;
    for (const auto& [name, place] : skeleton.end_points)
        if (name == end_point_name(skeleton_template, joint)) return place;
    return std::nullopt;
}

} // namespace detail

/// All bones of a skeleton, in its coordinates, in the order of their joints, of one joint in that of its children. An
/// end joint whose end point is not known has none. \throws Error usage when the skeleton's joints are not the
/// template's.
template <typename Scalar>
std::vector<Bone<Scalar>> bones_of(const KinematicSkeleton<Scalar>& skeleton,
                                   const SkeletonTemplate& skeleton_template) {
    detail::require_same_joints(skeleton, skeleton_template);
    std::vector<Bone<Scalar>> bones;
    for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
        const Joint<Scalar>& joint = skeleton.joints[j];
        for (const Joint<Scalar>& child : skeleton.joints)
            if (child.parent == static_cast<int>(j))
                bones.push_back({static_cast<int>(j), joint.position, child.position, joint.radius, child.radius});
        if (const auto end = detail::end_point_of(skeleton, skeleton_template, static_cast<int>(j)))
            bones.push_back({static_cast<int>(j), joint.position, *end, joint.radius, joint.radius});
    }
    return bones;
}

/// The child that continues a joint's bone: that of the same limb, in the trunk the one towards the head; -1 for an end
/// joint. O(joints).
inline int next_joint(const SkeletonTemplate& skeleton_template, int joint) {
    for (std::size_t j = 0; j < skeleton_template.joints.size(); ++j)
        if (skeleton_template.joints[j].parent == joint &&
            part_of(skeleton_template.joints[j].role) == part_of(skeleton_template.joint(joint).role))
            return static_cast<int>(j);
    return -1;
}

/// Where a joint's own bone ends: at `next_joint`, or at the limb's end on the surface; the joint's own place where
/// neither is known. \throws Error usage when the skeleton's joints are not the template's.
template <typename Scalar>
Vector3<Scalar> bone_end(const KinematicSkeleton<Scalar>& skeleton, const SkeletonTemplate& skeleton_template,
                         int joint) {
    detail::require_same_joints(skeleton, skeleton_template);
    if (const int next = next_joint(skeleton_template, joint); next >= 0)
        return skeleton.joints[static_cast<std::size_t>(next)].position;
    const auto end = detail::end_point_of(skeleton, skeleton_template, joint);
    return end ? *end : skeleton.joints[static_cast<std::size_t>(joint)].position;
}

/// A template's rest pose as a skeleton: x to the left, y up, z forward, in the template's unit.
template <typename Scalar>
KinematicSkeleton<Scalar> rest_skeleton(const SkeletonTemplate& skeleton_template) {
    KinematicSkeleton<Scalar> out;
    out.template_name = skeleton_template.name;
    for (const TemplateJoint& joint : skeleton_template.joints) {
        out.joints.push_back(
            {joint.name, joint.parent, joint.position.cast<Scalar>(), static_cast<Scalar>(joint.radius)});
        if (joint.tip)
            out.end_points.emplace_back(end_point_name(skeleton_template, joint), joint.tip->template cast<Scalar>());
    }
    out.frame.left = Vector3<Scalar>::UnitX();
    out.frame.up = Vector3<Scalar>::UnitY();
    out.frame.forward = Vector3<Scalar>::UnitZ();
    return out;
}

} // namespace skelgen::applications
