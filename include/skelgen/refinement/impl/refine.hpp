#pragma once

#include <skelgen/refinement/refine.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

#include <skelgen/core/geometry.hpp>
#include <skelgen/refinement/cross_section.hpp>
#include <skelgen/refinement/fork.hpp>
#include <skelgen/refinement/hip_anchor.hpp>
#include <skelgen/refinement/limbs.hpp>
#include <skelgen/refinement/placement.hpp>

namespace skelgen::refinement {
namespace detail {

template <typename Scalar>
bool is_head(const Limb<Scalar>& limb, const SkeletonTemplate& skeleton_template) {
    return skeleton_template.joint(limb.joints.back()).role == JointRole::head;
}

template <typename Scalar>
std::optional<HeadShape<Scalar>> head_of(const Limb<Scalar>& limb, const Slicer<Scalar>& slicer,
                                         const HeadOptions& options) {
    if (limb.joints.size() < 2) return std::nullopt; // no neck
    return measure_head(slicer, tip_of(limb), point_on(limb, arc_of(limb, 0)), options);
}

/// The head's limb, drawn again where the head is plainly larger than the template's: a child's. The neck lies that
/// much lower; the head's joint stays where it was, in the middle of the larger head.
template <typename Scalar>
Limb<Scalar> with_fitting_head(Limb<Scalar> limb, const Slicer<Scalar>& slicer, const EndPoint<Scalar>& end,
                               const RefinementOptions& options) {
    const auto head = head_of(limb, slicer, options.head);
    if (!head || head->size < static_cast<Scalar>(options.larger_head)) return limb;
    for (std::size_t i = 0; i + 1 < limb.from_tip.size(); ++i) limb.from_tip[i] *= head->size;
    return draw_limb(std::move(limb), slicer, end, options.centreline);
}

/// The axis of the lower trunk; none without two legs and a head.
template <typename Scalar>
std::optional<TrunkAxis<Scalar>>
trunk_axis_of(const std::vector<Limb<Scalar>>& limbs, const std::vector<EndPoint<Scalar>>& ends,
              const Slicer<Scalar>& slicer, const CurveSkeleton<Scalar>& curve, const embedding::Embedding& embedding,
              const SkeletonTemplate& skeleton_template, Scalar scale) {
    const std::vector<std::size_t> legs = find_legs(limbs, skeleton_template);
    std::optional<Vector3<Scalar>> neck;
    for (const Limb<Scalar>& limb : limbs)
        if (is_head(limb, skeleton_template)) neck = point_on(limb, arc_of(limb, 0));
    if (legs.empty() || !neck) return std::nullopt;
    const auto fork = fork_between(slicer.mesh(), ends[legs[0]], ends[legs[1]]);
    if (!fork) return std::nullopt;
    const int chest = find_joint(skeleton_template, JointRole::chest);
    const auto trunk = std::find_if(embedding.chains.begin(), embedding.chains.end(),
                                    [&](const embedding::Chain& chain) { return chain.joints.back() == chest; });
    if (trunk == embedding.chains.end()) return std::nullopt;
    Points<Scalar> line(static_cast<Eigen::Index>(trunk->nodes.size()) + 2, 3);
    line.row(0) = fork->transpose();
    for (std::size_t i = 0; i < trunk->nodes.size(); ++i)
        line.row(static_cast<Eigen::Index>(i) + 1) = curve.nodes.row(trunk->nodes[i]);
    line.row(line.rows() - 1) = neck->transpose();
    return find_trunk_axis(slicer, line, scale * rest_length_of_first_bone(limbs[legs[0]], skeleton_template));
}

/// The limbs of a body, rest-pose length to body length, and the axis of the lower trunk, if that can be seen.
template <typename Scalar>
struct ScaledLimbs {
    std::vector<Limb<Scalar>> limbs;
    Scalar scale;
    std::optional<TrunkAxis<Scalar>> axis;
};

/// Limbs traced, and their joints where the thickness of arms and legs and the size of the head say they are. The bones
/// measured tell the body's scale better than its geodesic diameter does, which changes with the pose.
template <typename Scalar>
ScaledLimbs<Scalar> find_limbs(const Slicer<Scalar>& slicer, const std::vector<EndPoint<Scalar>>& ends,
                               const CurveSkeleton<Scalar>& curve, const embedding::Embedding& embedding,
                               const SkeletonTemplate& skeleton_template, const RefinementOptions& options) {
    const Scalar scale = template_scale(skeleton_template, geodesic_diameter(ends));
    std::vector<Limb<Scalar>> traced =
        shorten_cut_limbs(trace_limbs(slicer, ends, skeleton_template, scale, options.centreline), slicer, ends,
                          skeleton_template, options.thickness_profile, options.centreline);
    const auto axis = trunk_axis_of(traced, ends, slicer, curve, embedding, skeleton_template, scale);
    if (axis) traced = anchor_hips(std::move(traced), *axis, skeleton_template, scale, options.bone_line);
    auto [limbs, ratio] = match_thickness_profiles(std::move(traced), skeleton_template, options.thickness_profile);
    for (std::size_t i = 0; i < limbs.size(); ++i) {
        if (!is_head(limbs[i], skeleton_template)) continue;
        for (Scalar& from_tip : limbs[i].from_tip) from_tip *= ratio;
        limbs[i] = with_fitting_head(std::move(limbs[i]), slicer, ends[i], options);
    }
    return {std::move(limbs), ratio * scale, axis};
}

template <typename Scalar>
std::optional<TrunkShape<Scalar>> trunk_of(const Placement<Scalar>& placement, const Slicer<Scalar>& slicer) {
    const std::vector<int> hips = placement.all(JointRole::hip);
    const int neck = placement.find(JointRole::neck);
    if (hips.size() != 2 || neck < 0) return std::nullopt;
    return measure_trunk(slicer, *placement.middle(JointRole::hip), placement.at(neck),
                         Vector3<Scalar>(placement.at(hips[0]) - placement.at(hips[1])));
}

} // namespace detail

template <typename Scalar>
RefinedJoints<Scalar> refine(const Body<Scalar>& body, const std::vector<EndPoint<Scalar>>& ends,
                             const CurveSkeleton<Scalar>& curve, const embedding::Embedding& embedding,
                             const SkeletonTemplate& skeleton_template, const RefinementOptions& options) {
    validate(options);
    const Slicer<Scalar> slicer(body);
    const auto [limbs, scale, axis] = detail::find_limbs(slicer, ends, curve, embedding, skeleton_template, options);
    Placement<Scalar> placement(skeleton_template, scale);
    RefinedJoints<Scalar> out;
    for (const Limb<Scalar>& limb : limbs) {
        placement = place_by_ratio(std::move(placement), limb);
        if (detail::is_head(limb, skeleton_template)) out.head = detail::head_of(limb, slicer, options.head);
        if (detail::is_head(limb, skeleton_template) && out.head)
            placement = place_neck(std::move(placement), limb, *out.head, options.neck);
        placement = place_wrist(std::move(placement), limb, options.wrist);
        placement = place_bend(std::move(placement), limb, options.bend, options.bone_line);
    }
    for (const Limb<Scalar>& limb : limbs)
        placement = place_girdle(std::move(placement), limb, options.girdle, options.bone_line);
    placement = narrow_hips(std::move(placement), limbs);
    const auto with_pelvis =
        axis ? place_pelvis(placement, limbs, *axis, options.pelvis) : std::optional<Placement<Scalar>>();
    if (with_pelvis) placement = *with_pelvis;
    const int junction = embedding.node_of_joint[static_cast<std::size_t>(placement.find(JointRole::chest))];
    placement = place_trunk(std::move(placement), limbs, slicer, core::point(curve.nodes, junction),
                            with_pelvis.has_value(), options.trunk);
    placement = raise_crotch(std::move(placement), limbs, body.mesh, options.crotch);

    out.positions = placement.positions();
    out.trunk = detail::trunk_of(placement, slicer);
    out.is_present.assign(skeleton_template.joints.size(), true);
    for (const Limb<Scalar>& limb : limbs) {
        for (std::size_t i = limb.joints.size() - limb.missing; i < limb.joints.size(); ++i)
            out.is_present[static_cast<std::size_t>(limb.joints[i])] = false;
        if (limb.missing == 0) out.tips.emplace_back(limb.joints.back(), tip_of(limb));
    }
    return out;
}

} // namespace skelgen::refinement
