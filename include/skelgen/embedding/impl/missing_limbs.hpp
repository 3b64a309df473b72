#pragma once

#include <skelgen/embedding/missing_limbs.hpp>

namespace skelgen::embedding {

SKELGEN_INLINE std::vector<PartialTemplate> partial_templates(const SkeletonTemplate& skeleton_template) {
    using enum JointRole;
    struct Part {
        JointRole first, end;
        Side side;
    };
    std::vector<PartialTemplate> out;
    for (const Part& part : {Part{head, head, Side::none}, Part{elbow, hand, Side::left}, Part{knee, foot, Side::left},
                             Part{wrist, hand, Side::left}, Part{ankle, foot, Side::left}}) {
        const int first = find_joint(skeleton_template, part.first, part.side);
        if (first < 0) continue;
        out.push_back({without_limb(skeleton_template, first), find_joint(skeleton_template, part.end, part.side)});
    }
    return out;
}

SKELGEN_INLINE double distortion_per_pair(const Embedding& embedding) {
    const double nodes = embedding.matched_nodes;
    return 2 * embedding.distortion / (nodes * (nodes - 1));
}

} // namespace skelgen::embedding
