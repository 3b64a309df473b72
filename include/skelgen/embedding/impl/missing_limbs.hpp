#pragma once

#include <skelgen/embedding/missing_limbs.hpp>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace skelgen::embedding {
namespace detail {

/// The templates of bodies that lack a limb, as without_a_limb() has them, with joints that are absent.
inline std::vector<SkeletonTemplate> partial_templates(const SkeletonTemplate& skeleton_template) {
    using enum JointRole;
    struct First {
        JointRole role;
        Side side;
    };
    std::vector<SkeletonTemplate> out;
    for (const auto& [role, side] : {First{head, Side::none}, First{elbow, Side::left}, First{knee, Side::left},
                                     First{wrist, Side::left}, First{ankle, Side::left}})
        if (const int first = find_joint(skeleton_template, role, side); first >= 0)
            out.push_back(without_limb(skeleton_template, first));
    return out;
}

/// The curve's nodes that stand for head, hands, feet and junctions, each pair in order: left and right are not known.
inline std::vector<int> nodes_by_role(const LaidTemplate& laid) {
    const auto& [skeleton_template, embedding] = laid;
    std::vector<int> out;
    for (std::size_t j = 0; j < skeleton_template.joints.size(); ++j) {
        const int other = counterpart(skeleton_template, static_cast<int>(j));
        const int node = embedding.node_of_joint[j];
        if (other < 0) {
            out.push_back(node);
        } else if (static_cast<int>(j) < other) {
            out.push_back(std::min(node, embedding.node_of_joint[at(other)]));
            out.push_back(std::max(node, embedding.node_of_joint[at(other)]));
        }
    }
    return out;
}

} // namespace detail

template <typename Scalar>
std::vector<LaidTemplate> without_a_limb(const CurveSkeleton<Scalar>& curve, const SkeletonTemplate& skeleton_template,
                                         std::size_t most, const MatchingOptions& options) {
    if (std::any_of(skeleton_template.joints.begin(), skeleton_template.joints.end(),
                    [](const TemplateJoint& joint) { return joint.is_absent; }))
        return {};
    std::vector<LaidTemplate> found;
    for (SkeletonTemplate& part : detail::partial_templates(skeleton_template))
        if (auto embedding = embed(curve, part, options)) found.push_back({std::move(part), *std::move(embedding)});
    std::stable_sort(found.begin(), found.end(), [](const LaidTemplate& a, const LaidTemplate& b) {
        return distortion_per_pair(a.embedding) < distortion_per_pair(b.embedding);
    });
    std::vector<LaidTemplate> out;
    for (LaidTemplate& laid : found) {
        const bool is_known = std::any_of(out.begin(), out.end(), [&](const LaidTemplate& other) {
            return detail::nodes_by_role(other) == detail::nodes_by_role(laid);
        });
        if (!is_known && out.size() < most) out.push_back(std::move(laid));
    }
    return out;
}

} // namespace skelgen::embedding
