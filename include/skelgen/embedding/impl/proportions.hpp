#pragma once

#include <skelgen/embedding/proportions.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include <skelgen/embedding/embed.hpp>
#include <skelgen/embedding/missing_limbs.hpp>

namespace skelgen::embedding {
namespace detail {

/// A child of two; figures of three and of two heads, as toys and games have them; one with a large head alone; the
/// brute of drawn stories. Multiples of an adult's lengths beside the trunk, working values; legs of figures fill the
/// trunk's width.
inline constexpr std::array<Proportions, 5> other_proportions{
    {{1.35, 0.8, 0.75, 1}, {2.0, 0.6, 0.5, 1.6}, {2.2, 0.4, 0.4, 1.6}, {1.8, 0.75, 0.7, 1.6}, {1.5, 1.0, 0.5, 1.6}}};

/// Up to this distortion per pair there is nothing to explain: registered bodies have 0.005 at most.
inline constexpr double well_fitted_body = 0.006;

/// So little distorted other proportions are to be: drawn figures' are, with the right ones, to 0.003, wolves, horses
/// and toy animals 0.004 to 0.008.
inline constexpr double well_fitted_figure = 0.004;

/// And so little of the curve is to be left over, as a part of the chains: a dog's tail and ears are 0.4, figures have
/// less than 0.1.
inline constexpr double left_over = 0.15;

} // namespace detail

SKELGEN_INLINE SkeletonTemplate with_proportions(const SkeletonTemplate& skeleton_template,
                                                 const Proportions& proportions) {
    using enum JointRole;
    SkeletonTemplate out = skeleton_template;
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

template <typename Scalar>
FittingTemplate fitting_proportions(const CurveSkeleton<Scalar>& curve, const SkeletonTemplate& skeleton_template,
                                    const MatchingOptions& options) {
    FittingTemplate out{skeleton_template, false, false};
    const bool is_partial = std::any_of(skeleton_template.joints.begin(), skeleton_template.joints.end(),
                                        [](const TemplateJoint& joint) { return joint.is_absent; });
    if (is_partial) return out;
    const auto whole = embed(curve, skeleton_template, options);
    if (!whole || distortion_per_pair(*whole) <= detail::well_fitted_body) return out;
    double least = std::min(distortion_per_pair(*whole) / 2, detail::well_fitted_figure);
    for (const Proportions& proportions : detail::other_proportions) {
        SkeletonTemplate other = with_proportions(skeleton_template, proportions);
        const auto found = embed(curve, other, options);
        if (!found || !(distortion_per_pair(*found) < least)) continue;
        if (static_cast<double>(unmatched_share(curve, *found)) > detail::left_over) continue;
        least = distortion_per_pair(*found);
        out = {std::move(other), true, false};
    }
    out.fits_badly = !out.is_odd;
    return out;
}

} // namespace skelgen::embedding
