#pragma once

#include <skelgen/applications/part_axes.hpp>

#include <algorithm>
#include <string>

#include <skelgen/applications/body_coordinates.hpp>
#include <skelgen/core/geometry.hpp>

namespace skelgen::applications {
namespace detail {

template <typename Scalar>
AxisPoint<Scalar> between(const AxisPoint<Scalar>& a, const AxisPoint<Scalar>& b, Scalar along) {
    return {a.place + along * (b.place - a.place), a.radius + along * (b.radius - a.radius)};
}

} // namespace detail

template <typename Scalar>
std::vector<PartAxis<Scalar>> part_axes(const KinematicSkeleton<Scalar>& skeleton) {
    using detail::between, detail::sided_part, detail::trunk_part;
    using Point = AxisPoint<Scalar>;
    const auto at = [&](const std::string& name) {
        const Vector3<Scalar> place = joint_place(skeleton, name);
        return Point{place, skeleton.joints[static_cast<std::size_t>(find_joint(skeleton, name))].radius};
    };
    const auto end = [&](const std::string& name, const std::string& joint) {
        return Point{end_place(skeleton, name, joint), Scalar(0)};
    };
    const Scalar half = Scalar(0.5);
    const Point crotch = at("crotch"), waist = at("waist"), chest = at("chest"), neck = at("neck"), head = at("head");
    const Point hip_bone = between(crotch, waist, half), ribs = between(waist, chest, half);
    const Point throat = between(neck, head, half); // the jaw hangs below the head's joint
    std::vector<PartAxis<Scalar>> axes;
    axes.push_back({trunk_part("pelvis"), LimbEnd::none, crotch, hip_bone});
    axes.push_back({trunk_part("abdomen"), LimbEnd::none, hip_bone, waist});
    axes.push_back({trunk_part("abdomen"), LimbEnd::none, waist, ribs});
    axes.push_back({trunk_part("chest"), LimbEnd::none, ribs, chest});
    axes.push_back({trunk_part("chest"), LimbEnd::none, chest, neck});
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
