#pragma once

#include <skelgen/embedding/proportions.hpp>

#include <cstddef>

namespace skelgen::embedding {

SKELGEN_INLINE SkeletonTemplate with_proportions(const SkeletonTemplate& skeleton_template,
                                                 const Proportions& proportions) {
    using enum JointRole;
    SkeletonTemplate out = skeleton_template;
    out.is_adapted = true;
    for (std::size_t j = 0; j < out.joints.size(); ++j) {
        TemplateJoint& joint = out.joints[j];
        const TemplateJoint& before = skeleton_template.joints[j];
        const BodyPart part = part_of(joint.role);
        const double size = part == BodyPart::arm   ? proportions.arms
                            : part == BodyPart::leg ? proportions.legs
                            : joint.role == head    ? proportions.head
                                                    : 1;
        const bool is_trunks = joint.role == shoulder || joint.role == hip || joint.role == head;
        if (joint.parent >= 0)
            joint.position =
                out.joint(joint.parent).position +
                (is_trunks ? 1 : size) * (before.position - skeleton_template.joint(joint.parent).position);
        if (joint.role == hip) joint.position.x() += (proportions.hips - 1) * before.position.x();
        joint.radius = size * before.radius;
        if (before.tip) joint.tip = joint.position + size * (*before.tip - before.position);
    }
    return out;
}

} // namespace skelgen::embedding
