#pragma once

#include <skelgen/embedding/missing_limbs.hpp>

#include <algorithm>
#include <utility>

namespace skelgen::embedding {

SKELGEN_INLINE std::vector<SkeletonTemplate> partial_templates(const SkeletonTemplate& skeleton_template) {
    using enum JointRole;
    std::vector<SkeletonTemplate> out;
    for (const auto& [first, side] :
         {std::pair(head, Side::none), std::pair(elbow, Side::left), std::pair(knee, Side::left),
          std::pair(wrist, Side::left), std::pair(ankle, Side::left)})
        if (const int joint = find_joint(skeleton_template, first, side); joint >= 0)
            out.push_back(without_limb(skeleton_template, joint));
    return out;
}

SKELGEN_INLINE double distortion_per_pair(const Embedding& embedding) {
    const double nodes = embedding.matched_nodes;
    return 2 * embedding.distortion / (nodes * (nodes - 1));
}

template <typename Scalar>
Outcome<FittingTemplate> fitting_template(const CurveSkeleton<Scalar>& curve, const SkeletonTemplate& skeleton_template,
                                          const MatchingOptions& options) {
    auto found = embed(curve, skeleton_template, options);
    if (!found) return found.failure();
    return FittingTemplate{skeleton_template, *std::move(found)};
}

template <typename Scalar>
std::vector<FittingTemplate> fitting_without_limb(const CurveSkeleton<Scalar>& curve,
                                                  const SkeletonTemplate& skeleton_template, std::size_t most,
                                                  const MatchingOptions& options) {
    std::vector<FittingTemplate> found;
    const bool is_partial = std::any_of(skeleton_template.joints.begin(), skeleton_template.joints.end(),
                                        [](const TemplateJoint& joint) { return joint.is_absent; });
    if (is_partial) return found;
    for (const SkeletonTemplate& part : partial_templates(skeleton_template))
        if (auto laid = fitting_template(curve, part, options)) found.push_back(*std::move(laid));
    std::stable_sort(found.begin(), found.end(), [](const FittingTemplate& a, const FittingTemplate& b) {
        return distortion_per_pair(a.embedding) < distortion_per_pair(b.embedding);
    });
    if (found.size() > most) found.erase(found.begin() + static_cast<std::ptrdiff_t>(most), found.end());
    return found;
}

} // namespace skelgen::embedding
