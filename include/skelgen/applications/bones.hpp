#pragma once

#include <vector>

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

/// All bones of a skeleton, in its coordinates, in the order of their joints, of one joint in that of its children. An
/// end joint whose end point is not known has none. \throws Error usage when the skeleton's joints are not the
/// template's.
template <typename Scalar>
[[nodiscard]] std::vector<Bone<Scalar>> bones_of(const KinematicSkeleton<Scalar>& skeleton,
                                                 const SkeletonTemplate& skeleton_template);

/// The child that continues a joint's bone: that of the same limb, in the trunk the one towards the head; -1 for an end
/// joint. O(joints).
[[nodiscard]] int next_joint(const SkeletonTemplate& skeleton_template, int joint);

/// Where a joint's own bone ends: at `next_joint`, or at the limb's end on the surface; the joint's own place where
/// neither is known. \throws Error usage when the skeleton's joints are not the template's.
template <typename Scalar>
[[nodiscard]] Vector3<Scalar> bone_end(const KinematicSkeleton<Scalar>& skeleton,
                                       const SkeletonTemplate& skeleton_template, int joint);

/// A template's rest pose as a skeleton: x to the left, y up, z forward, in the template's unit.
template <typename Scalar>
[[nodiscard]] KinematicSkeleton<Scalar> rest_skeleton(const SkeletonTemplate& skeleton_template);

/// Which joints a joint carries, itself among them. O(joints).
[[nodiscard]] inline std::vector<bool> joints_below(const SkeletonTemplate& skeleton_template, int joint) {
    std::vector<bool> is_below(skeleton_template.joints.size(), false);
    for (std::size_t j = 0; j < is_below.size(); ++j) {
        const int parent = skeleton_template.joints[j].parent;
        is_below[j] = static_cast<int>(j) == joint || (parent >= 0 && is_below[static_cast<std::size_t>(parent)]);
    }
    return is_below;
}

} // namespace skelgen::applications

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/applications/impl/bones.hpp>
#endif
