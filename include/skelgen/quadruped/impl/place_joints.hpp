#pragma once

#include <skelgen/quadruped/place_joints.hpp>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <skelgen/core/curve_graph.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/quadruped/joint_table.hpp>

namespace skelgen::quadruped {
namespace detail {

/// The way that a joint lies on.
template <typename Scalar>
const std::vector<int>& way_of(const Limbs<Scalar>& limbs, Way way, Side side) {
    switch (way) {
    case Way::fore_leg:
        return limbs.legs[static_cast<std::size_t>(side == Side::right ? right_fore : left_fore)];
    case Way::hind_leg:
        return limbs.legs[static_cast<std::size_t>(side == Side::right ? right_hind : left_hind)];
    case Way::trunk:
        return limbs.trunk;
    case Way::neck:
        return limbs.neck;
    case Way::tail:
        break;
    }
    return limbs.tail;
}

/// The place at a share of a way's length, and the radius there.
template <typename Scalar>
std::pair<Vector3<Scalar>, Scalar> along(const CurveSkeleton<Scalar>& curve, const std::vector<int>& way,
                                         double share) {
    Scalar left = static_cast<Scalar>(share) * core::path_length(curve, way);
    for (std::size_t i = 1; i < way.size(); ++i) {
        const Vector3<Scalar> from = core::point(curve.nodes, way[i - 1]), to = core::point(curve.nodes, way[i]);
        const Scalar length = (to - from).norm();
        if (left <= length && length > 0)
            return {from + (to - from) * (left / length), curve.radii[static_cast<std::size_t>(way[i])]};
        left -= length;
    }
    return {core::point(curve.nodes, way.back()), curve.radii[static_cast<std::size_t>(way.back())]};
}

/// The animal's directions at its head, which may be turned and lowered: forward along the end of the neck.
template <typename Scalar>
BodyFrame<Scalar> head_frame(const CurveSkeleton<Scalar>& curve, const Limbs<Scalar>& limbs) {
    BodyFrame<Scalar> out = limbs.frame;
    constexpr double before = 0.7;
    const Vector3<Scalar> way = along(curve, limbs.neck, 1.0).first - along(curve, limbs.neck, before).first;
    if (!(way.norm() > 0)) return out;
    out.forward = way.normalized();
    const Vector3<Scalar> up = out.forward.cross(limbs.frame.left);
    if (!(up.norm() > 0)) return limbs.frame;
    out.up = up.normalized();
    out.left = out.up.cross(out.forward);
    return out;
}

/// How many joints of the same role and side come before a joint.
inline int ordinal_of(const SkeletonTemplate& skeleton_template, int joint) {
    const TemplateJoint& own = skeleton_template.joint(joint);
    int out = 0;
    for (int j = 0; j < joint; ++j)
        if (const TemplateJoint& other = skeleton_template.joint(j); other.role == own.role && other.side == own.side)
            ++out;
    return out;
}

} // namespace detail

template <typename Scalar>
KinematicSkeleton<Scalar> place_joints(const CurveSkeleton<Scalar>& curve, const Limbs<Scalar>& limbs,
                                       const SkeletonTemplate& skeleton_template) {
    KinematicSkeleton<Scalar> out;
    out.template_name = skeleton_template.name;
    const BodyFrame<Scalar> head = detail::head_frame(curve, limbs);
    for (int j = 0; j < static_cast<int>(skeleton_template.joints.size()); ++j) {
        const TemplateJoint& wanted = skeleton_template.joint(j);
        Joint<Scalar>& joint = out.joints.emplace_back();
        joint.name = wanted.name;
        joint.parent = wanted.parent;
        const JointPlace& place = place_of(wanted.role, detail::ordinal_of(skeleton_template, j));
        const std::vector<int>& way = detail::way_of(limbs, place.way, wanted.side);
        if (way.empty()) {
            joint.is_present = false;
            joint.position = limbs.frame.origin;
            continue;
        }
        const BodyFrame<Scalar>& frame = wanted.role == JointRole::ear ? head : limbs.frame;
        const auto [on_way, radius] = detail::along(curve, way, place.share);
        const auto outward = static_cast<Scalar>(sign_of(wanted.side) * place.outward);
        joint.position = on_way + limbs.size * (static_cast<Scalar>(place.forward) * frame.forward +
                                                static_cast<Scalar>(place.up) * frame.up + outward * frame.left);
        joint.radius = radius;
    }
    out.frame = limbs.frame;
    out.frame.origin = out.joints.front().position;
    out.end_points.emplace_back("head_tip", core::point(curve.nodes, limbs.neck.back()));
    for (const Side side : {Side::left, Side::right})
        for (const auto& [way, name] : {std::pair(Way::fore_leg, "fore_toe"), std::pair(Way::hind_leg, "hind_toe")})
            out.end_points.emplace_back(std::string(side_prefix(side)) + name,
                                        core::point(curve.nodes, detail::way_of(limbs, way, side).front()));
    if (!limbs.tail.empty()) out.end_points.emplace_back("tail_tip", core::point(curve.nodes, limbs.tail.back()));
    return out;
}

} // namespace skelgen::quadruped
