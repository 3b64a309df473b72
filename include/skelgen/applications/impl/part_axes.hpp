#pragma once

#include <skelgen/applications/part_axes.hpp>

#include <algorithm>
#include <string>

#include <skelgen/applications/body_coordinates.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/header_only.hpp>

namespace skelgen::applications {
namespace detail {

template <typename Scalar>
AxisPoint<Scalar> between(const AxisPoint<Scalar>& a, const AxisPoint<Scalar>& b, Scalar along) {
    return {a.place + along * (b.place - a.place), a.radius + along * (b.radius - a.radius)};
}

/// The end that a joint of this role leads to.
[[nodiscard]] constexpr LimbEnd end_of(JointRole role, Side side) {
    if (role == JointRole::tail) return LimbEnd::tail;
    if (part_of(role) == BodyPart::arm) return side == Side::left ? LimbEnd::left_hand : LimbEnd::right_hand;
    if (part_of(role) == BodyPart::leg) return side == Side::left ? LimbEnd::left_foot : LimbEnd::right_foot;
    return LimbEnd::none;
}

inline const TemplateJoint& last_of(const SkeletonTemplate& own, JointRole role) {
    return *std::find_if(own.joints.rbegin(), own.joints.rend(), [&](const auto& joint) { return joint.role == role; });
}

template <typename Scalar>
std::vector<PartAxis<Scalar>> animal_axes(const KinematicSkeleton<Scalar>& skeleton, const SkeletonTemplate& own) {
    const std::vector<std::string> names = part_names(PartSet::bones, own.plan);
    const auto part = [&](const TemplateJoint& joint) {
        const std::string_view plain = animal_part(joint.role);
        const bool is_sided = part_of(joint.role) != BodyPart::trunk;
        const std::string name = std::string(is_sided ? side_prefix(joint.side) : "").append(plain);
        return static_cast<int>(std::find(names.begin(), names.end(), name) - names.begin());
    };
    const auto at = [&](const TemplateJoint& joint) {
        const int found = find_joint(skeleton, joint.name);
        return AxisPoint<Scalar>{joint_place(skeleton, joint.name),
                                 skeleton.joints[static_cast<std::size_t>(found)].radius};
    };
    const auto is_there = [&](const TemplateJoint& joint) {
        const int found = find_joint(skeleton, joint.name);
        return found < 0 || skeleton.joints[static_cast<std::size_t>(found)].is_present; // what is missing is refused
    };
    std::vector<PartAxis<Scalar>> axes;
    for (const TemplateJoint& joint : own.joints) {
        if (!is_there(joint)) continue;
        if (joint.parent >= 0) {
            const TemplateJoint& before = own.joint(joint.parent);
            // Ribs reach as far back as the bone before the chest's joint.
            const TemplateJoint& owner = joint.role == JointRole::chest ? joint : before;
            axes.push_back({part(owner), end_of(owner.role, owner.side), at(before), at(joint)});
        }
        const std::string tip = joint.role == JointRole::tail ? "tail_tip"
                                : ends_limb(joint.role)       ? end_point_name(own, joint)
                                                              : "";
        const bool is_last = joint.role != JointRole::tail || &joint == &last_of(own, JointRole::tail);
        if (!tip.empty() && is_last)
            axes.push_back({part(joint),
                            end_of(joint.role, joint.side),
                            at(joint),
                            {end_place(skeleton, tip, joint.name), Scalar(0)}});
    }
    return axes;
}

} // namespace detail

SKELGEN_INLINE std::vector<std::string> part_names(PartSet set, BodyKind plan) {
    const bool is_human = plan == BodyKind::human;
    std::vector<std::string> names;
    if (set == PartSet::body)
        names =
            is_human ? std::vector<std::string>{"head", "torso"} : std::vector<std::string>{"head", "torso", "tail"};
    else if (is_human)
        names.assign(detail::trunk_parts.begin(), detail::trunk_parts.end());
    else
        names.assign(detail::animal_trunk_parts.begin(), detail::animal_trunk_parts.end());
    for (const std::string_view side : detail::sides) {
        const auto add = [&](const auto& parts) {
            for (const std::string_view part : parts)
                if (set == PartSet::bones || part != "shoulder") names.push_back(std::string(side) + std::string(part));
        };
        if (is_human)
            add(detail::sided_parts);
        else
            add(detail::animal_sided_parts);
    }
    return names;
}

template <typename Scalar>
std::vector<PartAxis<Scalar>> part_axes(const KinematicSkeleton<Scalar>& skeleton) {
    if (const SkeletonTemplate& own = own_template(skeleton); own.plan == BodyKind::quadruped)
        return detail::animal_axes(skeleton, own);
    using detail::between, detail::sided_part, detail::trunk_part;
    using Point = AxisPoint<Scalar>;
    const auto at = [&](const std::string& name) {
        const Vector3<Scalar> place = joint_place(skeleton, name);
        return Point{place, skeleton.joints[static_cast<std::size_t>(find_joint(skeleton, name))].radius};
    };
    const auto end = [&](const std::string& name, const std::string& joint) {
        return Point{end_place(skeleton, name, joint), Scalar(0)};
    };
    const Point crotch = at("crotch"), waist = at("waist"), chest = at("chest"), neck = at("neck"), head = at("head");
    const Point hips = between(at("left_hip"), at("right_hip"), Scalar(0.5));
    const Point throat = between(neck, head, Scalar(0.5)); // the jaw hangs below the head's joint
    // The joints of the trunk are where it bends, not where something ends: parts meet at fixed shares of the way from
    // between the hips over the waist to the neck, which is found again in other poses to less than any joint between.
    constexpr Scalar top_of_pelvis = Scalar(0.22), top_of_abdomen = Scalar(0.48); // of people who stand
    const Scalar lower = (waist.place - hips.place).norm(), upper = (neck.place - waist.place).norm();
    const auto on_trunk = [&](Scalar share) {
        const Scalar way = share * (lower + upper);
        return way < lower ? between(hips, waist, way / lower) : between(waist, neck, (way - lower) / upper);
    };
    const Point hip_bone = on_trunk(top_of_pelvis), ribs = on_trunk(top_of_abdomen);
    const bool waist_is_low =
        lower<top_of_pelvis*(lower + upper), waist_is_high = lower> top_of_abdomen * (lower + upper);
    std::vector<PartAxis<Scalar>> axes;
    const auto along_trunk = [&](const char* part, const Point& from, const Point& to, bool over_waist) {
        axes.push_back({trunk_part(part), LimbEnd::none, from, over_waist ? waist : to});
        if (over_waist) axes.push_back({trunk_part(part), LimbEnd::none, waist, to});
    };
    along_trunk("pelvis", hips, hip_bone, waist_is_low);
    along_trunk("abdomen", hip_bone, ribs, !waist_is_low && !waist_is_high);
    along_trunk("chest", ribs, neck, waist_is_high);
    axes.push_back({trunk_part("neck"), LimbEnd::none, neck, throat});
    axes.push_back({trunk_part("head"), LimbEnd::none, throat, head});
    axes.push_back({trunk_part("head"), LimbEnd::none, head, end("head_top", "head")});
    for (std::size_t s = 0; s < detail::sides.size(); ++s) {
        const std::string side(detail::sides[s]);
        const LimbEnd hand = s == 0 ? LimbEnd::left_hand : LimbEnd::right_hand;
        const LimbEnd foot = s == 0 ? LimbEnd::left_foot : LimbEnd::right_foot;
        const Point shoulder = at(side + "shoulder"), elbow = at(side + "elbow"), wrist = at(side + "wrist");
        const Point hip = at(side + "hip"), knee = at(side + "knee"), ankle = at(side + "ankle");
        const Point knuckles = at(side + "hand"), ball = at(side + "foot");
        axes.push_back({sided_part("shoulder", s), LimbEnd::none, chest, shoulder});
        axes.push_back({sided_part("upper_arm", s), hand, shoulder, elbow});
        axes.push_back({sided_part("forearm", s), hand, elbow, wrist});
        axes.push_back({sided_part("hand", s), hand, wrist, knuckles});
        axes.push_back({sided_part("hand", s), hand, knuckles, end(side + "fingertip", side + "hand")});
        axes.push_back({trunk_part("pelvis"), LimbEnd::none, crotch, hip});
        axes.push_back({sided_part("thigh", s), foot, hip, knee});
        axes.push_back({sided_part("calf", s), foot, knee, ankle});
        // The heel is as far behind the ankle as below it, and belongs to the foot.
        axes.push_back({sided_part("foot", s), foot, ankle, ball, Scalar(0.02)});
        axes.push_back({sided_part("foot", s), foot, ball, end(side + "toe", side + "foot")});
    }
    return axes;
}

template <typename Scalar>
Scalar distance_to_axis(const Vector3<Scalar>& place, const PartAxis<Scalar>& axis) {
    constexpr Scalar reluctance = Scalar(0.05);
    const Vector3<Scalar> from = axis.from.place, bone = axis.to.place - from;
    const core::NearestOnSegment<Scalar> nearest = core::nearest_on_segment<Scalar, 3>(place, from, axis.to.place);
    const Scalar radius = detail::between(axis.from, axis.to, nearest.along).radius, length = bone.norm();
    const Scalar distance = nearest.distance - radius / 4;
    if (!(length > 0)) return distance;
    const Scalar along = (place - from).dot(bone) / length;
    return distance + axis.reluctance_before * std::max(Scalar(0), -along) +
           reluctance * std::max(Scalar(0), along - length);
}

} // namespace skelgen::applications
