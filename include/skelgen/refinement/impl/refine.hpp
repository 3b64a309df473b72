#pragma once

#include <skelgen/refinement/refine.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>

#include <skelgen/core/geometry.hpp>
#include <skelgen/core/parallel.hpp>
#include <skelgen/refinement/cross_section.hpp>
#include <skelgen/refinement/fork.hpp>
#include <skelgen/refinement/impl/bare_joints.hpp>
#include <skelgen/refinement/impl/headgear.hpp>
#include <skelgen/refinement/impl/hem.hpp>
#include <skelgen/refinement/impl/hip_anchor.hpp>
#include <skelgen/refinement/impl/shoulder_anchor.hpp>
#include <skelgen/refinement/limbs.hpp>
#include <skelgen/refinement/placement.hpp>
#include <skelgen/refinement/trunk_axis.hpp>

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

/// The limb with its joints `factor` times as far from its tip.
template <typename Scalar>
Limb<Scalar> stretched(Limb<Scalar> limb, Scalar factor, const Slicer<Scalar>& slicer, const EndPoint<Scalar>& end,
                       const CentrelineOptions& options) {
    for (Scalar& from_tip : limb.from_tip) from_tip *= factor;
    return draw_limb(std::move(limb), slicer, end, options);
}

/// Does a head's throat lie as low as an adult's, three quarters of the way from top to neck, or nearly so? What is
/// thin higher up is a face between hands.
template <typename Scalar>
bool is_below_face(const Limb<Scalar>& limb, const HeadShape<Scalar>& head) {
    constexpr Scalar lowest_face = Scalar(0.6); // a working value
    const Vector3<Scalar> top = tip_of(limb), neck = point_on(limb, arc_of(limb, 0));
    return (top - *head.throat).dot(head.up) > lowest_face * (top - neck).norm();
}

/// A head may be so much larger than the template's that its slices, above the place where the template has the neck,
/// show no head at all: the limb drawn for the first of ever larger heads that is seen to end in a throat, and is no
/// smaller than that. None where there is no such one, as with hair, hats and hands on heads. Its neck is no farther
/// from the top than `lowest`: what is thin lower down is a waist.
template <typename Scalar>
std::optional<Limb<Scalar>> with_far_larger_head(const Limb<Scalar>& limb, const Slicer<Scalar>& slicer,
                                                 const EndPoint<Scalar>& end, Scalar lowest,
                                                 const RefinementOptions& options) {
    constexpr Scalar step = Scalar(1.25), most = Scalar(3.5); // times the template's
    for (Scalar factor = step; factor < most && factor * limb.from_tip.front() < lowest; factor *= step) {
        Limb<Scalar> larger = stretched(limb, factor, slicer, end, options.centreline);
        const auto head = head_of(larger, slicer, options.head);
        if (head && head->throat && head->size >= 1 && is_below_face(larger, *head)) return larger;
    }
    return std::nullopt;
}

/// The head's limb, drawn again where the head is plainly larger than the template's, a child's or a drawn figure's:
/// the neck lies that much lower. A larger head is measured once more, from where its neck then is. `lowest`: how far
/// from the top a neck may be that no head was seen above at first.
template <typename Scalar>
Limb<Scalar> with_fitting_head(Limb<Scalar> limb, const Slicer<Scalar>& slicer, const EndPoint<Scalar>& end,
                               Scalar lowest, const RefinementOptions& options) {
    constexpr int most_rounds = 3;
    const Scalar neck = limb.from_tip.front(), joint = limb.from_tip.back();
    auto head = head_of(limb, slicer, options.head);
    if (!head) {
        auto larger = with_far_larger_head(limb, slicer, end, lowest, options);
        if (!larger) return limb;
        limb = *std::move(larger);
        head = head_of(limb, slicer, options.head);
    }
    for (int round = 0; round < most_rounds && head && head->size >= static_cast<Scalar>(options.larger_head);
         ++round) {
        limb = stretched(std::move(limb), head->size, slicer, end, options.centreline);
        head = head_of(limb, slicer, options.head);
    }
    const Scalar measured = head ? head->size : Scalar(1);
    if (limb.joints.size() > 1)
        limb.from_tip.back() = joint * head_joint_growth(measured * limb.from_tip.front() / neck);
    return limb;
}

/// How far over the surface it is from a head's end to where the nearest arm leaves the trunk; infinite without arms.
template <typename Scalar>
Scalar distance_to_arms(const EndPoint<Scalar>& head, const std::vector<Limb<Scalar>>& limbs,
                        const Slicer<Scalar>& slicer, const SkeletonTemplate& skeleton_template) {
    Scalar least = std::numeric_limits<Scalar>::infinity();
    for (const Limb<Scalar>& limb : limbs) {
        if (part_of(skeleton_template.joint(limb.joints.front()).role) != BodyPart::arm) continue;
        const Vector3<Scalar> armpit = point_on(limb, std::max(limb.attachment, arc_of(limb, 0)));
        least = std::min(least, head.distance[core::nearest_vertex(slicer.mesh(), armpit)]);
    }
    return least;
}

/// The head's limb, of a head that may be larger than the template's, or wear something.
template <typename Scalar>
Limb<Scalar> head_limb(const Limb<Scalar>& limb, const Slicer<Scalar>& slicer, const EndPoint<Scalar>& end,
                       Scalar lowest, const CurveSkeleton<Scalar>& curve, const embedding::Embedding& embedding,
                       const RefinementOptions& options) {
    Limb<Scalar> fitting = with_fitting_head(limb, slicer, end, lowest, options);
    const auto throat = find_throat_on_curve(limb.joints.back(), curve, embedding, slicer);
    if (throat && has_neck_in_head(fitting, *throat, limb.from_tip.front()))
        return without_headgear(limb, *throat, slicer, options.centreline);
    return fitting;
}

/// Rings around the trunk nearer to the fork than this, in thighs, hold thighs, too. A working value.
template <typename Scalar>
inline constexpr Scalar lowest_ring = Scalar(0.4);

/// Places roughly through the trunk, upwards from above the fork to below the neck: the centres of its rings at equal
/// distance from the top of the head, which are the same however the curve was found; without a head, or with an
/// adapted template, which tells no lengths, the curve's nodes.
template <typename Scalar>
std::vector<Vector3<Scalar>>
places_along_trunk(const std::vector<Limb<Scalar>>& limbs, const std::vector<EndPoint<Scalar>>& ends,
                   const Slicer<Scalar>& slicer, const CurveSkeleton<Scalar>& curve,
                   const embedding::Embedding& embedding, const SkeletonTemplate& skeleton_template,
                   const Vector3<Scalar>& fork, Scalar thigh) {
    constexpr auto step = static_cast<Scalar>(CentrelineOptions{}.step);
    std::vector<Vector3<Scalar>> places;
    const int nearest = core::nearest_vertex(slicer.mesh(), fork);
    for (std::size_t i = 0; i < limbs.size(); ++i) {
        const Scalar lowest = ends[i].distance[nearest] - lowest_ring<Scalar> * thigh;
        const bool is_measured = is_head(limbs[i], skeleton_template) && !skeleton_template.is_adapted;
        if (!is_measured || !std::isfinite(lowest)) continue;
        const Points<Scalar> rings = ring_centres(slicer, ends[i], lowest, step);
        const auto below_neck = static_cast<Eigen::Index>(std::ceil((lowest - limbs[i].from_tip.front()) / step));
        for (Eigen::Index r = 0; r < std::min(below_neck, rings.rows()); ++r) places.push_back(core::point(rings, r));
    }
    if (!places.empty()) return places;
    const int chest = find_joint(skeleton_template, JointRole::chest);
    for (const embedding::Chain& chain : embedding.chains)
        if (chain.joints.back() == chest)
            for (const int node : chain.nodes) places.push_back(core::point(curve.nodes, node));
    return places;
}

/// The axis of the lower trunk; none without two legs.
template <typename Scalar>
std::optional<TrunkAxis<Scalar>>
trunk_axis_of(const std::vector<Limb<Scalar>>& limbs, const std::vector<EndPoint<Scalar>>& ends,
              const Slicer<Scalar>& slicer, const CurveSkeleton<Scalar>& curve, const embedding::Embedding& embedding,
              const SkeletonTemplate& skeleton_template, Scalar scale) {
    const std::vector<std::size_t> legs = find_legs(limbs, skeleton_template);
    if (legs.empty()) return std::nullopt;
    const auto fork = fork_between(slicer.mesh(), ends[legs[0]], ends[legs[1]]);
    if (!fork) return std::nullopt;
    const Scalar thigh = scale * rest_length_of_first_bone(limbs[legs[0]], skeleton_template);
    std::optional<TrunkAxis<Scalar>> axis;
    const auto find_axis = [&] {
        std::vector<Vector3<Scalar>> places =
            places_along_trunk(limbs, ends, slicer, curve, embedding, skeleton_template, *fork, thigh);
        if (places.empty()) return;
        places.insert(places.begin(), *fork);
        for (const Limb<Scalar>& limb : limbs)
            if (is_head(limb, skeleton_template)) places.push_back(point_on(limb, arc_of(limb, 0)));
        Points<Scalar> line(static_cast<Eigen::Index>(places.size()), 3);
        for (std::size_t i = 0; i < places.size(); ++i) core::set_point(line, static_cast<Eigen::Index>(i), places[i]);
        axis = find_trunk_axis(slicer, line, thigh);
    };
    // Half a thigh to both sides of the fork, in fortieths of it: more than a bent knee or an unlike end moves it.
    std::vector<Crossing<Scalar>> crossings;
    core::in_parallel(find_axis, [&] {
        crossings = crossings_between(slicer.mesh(), ends[legs[0]], ends[legs[1]], thigh, Scalar(0.05) * thigh);
    });
    if (!axis) return axis;
    axis->crossings = std::move(crossings);
    axis->fork = fork_along(axis->crossings, axis->place, axis->up);
    const auto leg = [&](std::size_t i) { return LegToEnd<Scalar>{limbs[legs[i]], ends[legs[i]]}; };
    axis->is_hem = is_hem(slicer, {leg(0), leg(1)}, *axis, thigh);
    return axis;
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
    std::vector<Limb<Scalar>> traced = trace_limbs(slicer, ends, skeleton_template, scale, options.centreline);
    if (options.limbs_may_be_cut)
        traced = shorten_cut_limbs(std::move(traced), slicer, ends, skeleton_template, options.thickness_profile,
                                   options.centreline);
    const auto axis = trunk_axis_of(traced, ends, slicer, curve, embedding, skeleton_template, scale);
    if (axis && !axis->is_hem)
        traced = anchor_hips(std::move(traced), *axis, skeleton_template, scale, options.bone_line);
    if (!skeleton_template.is_adapted) // a figure's arms may be as thick as they like
        traced = anchor_shoulders(std::move(traced), axis ? std::optional<Vector3<Scalar>>(axis->up) : std::nullopt,
                                  skeleton_template, options.bone_line);
    auto [limbs, ratio] = match_thickness_profiles(std::move(traced), skeleton_template, options.thickness_profile,
                                                   options.bend, options.bone_line);
    for (std::size_t i = 0; i < limbs.size(); ++i) {
        if (!is_head(limbs[i], skeleton_template)) continue;
        for (Scalar& from_tip : limbs[i].from_tip) from_tip *= ratio;
        const Scalar lowest = distance_to_arms(ends[i], limbs, slicer, skeleton_template);
        limbs[i] = head_limb(limbs[i], slicer, ends[i], lowest, curve, embedding, options);
    }
    return {std::move(limbs), ratio * scale, axis};
}

/// Shoulders by their height, as far on the way there as they are inside of the body.
template <typename Scalar>
Placement<Scalar> place_shoulders_by_height(Placement<Scalar> placement, const std::vector<Limb<Scalar>>& limbs,
                                            const Body<Scalar>& body, const GirdleOptions& options) {
    for (const Limb<Scalar>& limb : limbs) {
        const int joint = limb.joints.front();
        const Vector3<Scalar> here = placement.at(joint);
        const Vector3<Scalar> there = place_shoulder_by_height(placement, limb, options).at(joint);
        if (there == here) continue;
        for (const Scalar part : {Scalar(1), Scalar(0.75), Scalar(0.5), Scalar(0.25)}) {
            const Vector3<Scalar> place = here + part * (there - here);
            if (!surface::is_inside(body, place)) continue;
            placement.put(joint, place);
            break;
        }
    }
    return placement;
}

/// Shoulders by the trunk, where these and their elbows are then inside of the body: where the head shows no throat the
/// neck may be far off.
template <typename Scalar>
Placement<Scalar> place_shoulders_by_trunk(Placement<Scalar> placement, const std::vector<Limb<Scalar>>& limbs,
                                           const Vector3<Scalar>& fork, const Body<Scalar>& body,
                                           const RefinementOptions& options) {
    for (const Limb<Scalar>& limb : limbs) {
        const auto placed = place_shoulder_by_trunk(placement, limb, fork, options.bend, options.bone_line);
        const auto is_in = [&](int joint) { return surface::is_inside(body, placed.at(joint)); };
        if (limb.joints.size() > 1 && is_in(limb.joints[0]) && is_in(limb.joints[1])) placement = placed;
    }
    return placement;
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
    placement = place_bare_joints(std::move(placement), curve, embedding);
    placement = narrow_hips(std::move(placement), limbs);
    const auto with_pelvis =
        axis ? place_pelvis(placement, limbs, *axis, options.pelvis) : std::optional<Placement<Scalar>>();
    if (with_pelvis) placement = *with_pelvis;
    placement = detail::place_shoulders_by_height(std::move(placement), limbs, body, options.girdle);
    const int junction = embedding.node_of_joint[static_cast<std::size_t>(placement.find(JointRole::chest))];
    placement = place_trunk(std::move(placement), limbs, slicer, core::point(curve.nodes, junction),
                            with_pelvis ? axis : std::nullopt, options.trunk);
    placement = raise_crotch(std::move(placement), limbs, body.mesh, options.crotch);
    // Where the limbs look shorter than they are, as those of a body that sits, its fork may be the seat: not so its
    // crotch.
    if (axis) {
        const Vector3<Scalar> crotch = placement.at(0); // before it is moved from: arguments are evaluated in any order
        placement = detail::place_shoulders_by_trunk(std::move(placement), limbs, crotch, body, options);
    }

    out.positions = placement.positions();
    for (const TemplateJoint& joint : skeleton_template.joints) out.is_present.push_back(!joint.is_absent);
    for (std::size_t j = 0; j < out.is_present.size(); ++j)
        if (!out.is_present[j])
            out.positions.row(static_cast<Eigen::Index>(j)) = out.positions.row(skeleton_template.joints[j].parent);
    for (std::size_t l = 0; l < limbs.size(); ++l) {
        const Limb<Scalar>& limb = limbs[l];
        for (std::size_t i = limb.joints.size() - limb.missing; i < limb.joints.size(); ++i)
            out.is_present[static_cast<std::size_t>(limb.joints[i])] = false;
        const bool is_whole = limb.missing == 0 && ends_limb(skeleton_template.joint(limb.joints.back()).role);
        if (is_whole) out.tips.emplace_back(limb.joints.back(), core::point(body.mesh.vertices, ends[l].vertex));
    }
    return out;
}

} // namespace skelgen::refinement
