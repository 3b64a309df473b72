#pragma once

#include <algorithm>

#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/refinement/cross_section.hpp>
#include <skelgen/surface/body.hpp>

namespace skelgen::anatomy {

/// The skeleton with every joint's radius: mean distance to the contour around it across the bone from its parent (for
/// the root: to a child). A radius stays as it is where there is no contour within half the bone's length.
/// O(joints (n + m)).
template <typename Scalar>
KinematicSkeleton<Scalar> measure_radii(KinematicSkeleton<Scalar> skeleton, const Body<Scalar>& body) {
    const refinement::Slicer<Scalar> slicer(body);
    for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
        Joint<Scalar>& joint = skeleton.joints[j];
        if (!joint.is_present) continue;
        auto other = static_cast<std::size_t>(std::max(joint.parent, 0));
        if (joint.parent < 0)
            while (other + 1 < skeleton.joints.size() && skeleton.joints[other].parent != static_cast<int>(j)) ++other;
        const Vector3<Scalar> bone = joint.position - skeleton.joints[other].position;
        if (!(bone.norm() > 0)) continue;
        if (const auto section = slicer.around(joint.position, bone.normalized(), Scalar(0.5) * bone.norm()))
            joint.radius = section->thickness;
    }
    return skeleton;
}

} // namespace skelgen::anatomy
