#pragma once

#include <skelgen/core/geometry.hpp>
#include <skelgen/core/shoulder_height.hpp>
#include <skelgen/refinement/impl/shoulder_anchor.hpp>
#include <skelgen/refinement/limb_joints.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace skelgen::refinement {
namespace detail {

/// How much of the first bone, counted from elbow or knee, must be outside of the trunk for the place where the limb
/// enters it to tell the bone's direction. A working value, not a measured one.
template <typename Scalar>
inline constexpr Scalar least_visible_bone = Scalar(0.3);

} // namespace detail

template <typename Scalar>
Placement<Scalar> place_by_ratio(Placement<Scalar> placement, const Limb<Scalar>& limb) {
    for (std::size_t i = 0; i < limb.joints.size(); ++i) placement.put(limb.joints[i], point_on(limb, arc_of(limb, i)));
    return placement;
}

template <typename Scalar>
Placement<Scalar> place_neck(Placement<Scalar> placement, const Limb<Scalar>& limb, const HeadShape<Scalar>& head,
                             const NeckOptions& options) {
    const int neck = limb.joints.front();
    if (placement.role(neck) != JointRole::neck || !head.throat) return placement;
    const Vector3<Scalar> place = placement.at(neck);
    const Scalar height = (tip_of(limb) - place).norm();
    const Vector3<Scalar> by_throat = *head.throat - static_cast<Scalar>(options.below_throat) * height * head.up;
    const Vector3<Scalar> way = by_throat - place, upwards = way.dot(head.up) * head.up;
    const Scalar sense = head.frontness > 0 ? Scalar(1) : head.frontness < 0 ? Scalar(-1) : Scalar(0); // 0: no front
    const bool is_chin = sense * way.dot(head.forward) > static_cast<Scalar>(options.farthest_forward) * height;
    placement.put(neck, place + static_cast<Scalar>(options.throat_weight) * (is_chin ? upwards : way));
    return placement;
}

template <typename Scalar>
Placement<Scalar> place_wrist(Placement<Scalar> placement, const Limb<Scalar>& limb, const WristOptions& options) {
    const auto found = find_in_limb(limb, placement.skeleton_template(), JointRole::wrist);
    if (!found || *found == 0) return placement;
    const Scalar forearm = limb.from_tip[*found - 1] - limb.from_tip[*found];
    const Scalar window = static_cast<Scalar>(options.window) * forearm, centre = arc_of(limb, *found);
    const auto cost = [&](Eigen::Index i) {
        const Scalar off = (limb.line.arc[i] - centre) / forearm;
        return std::log(limb.line.thickness[i]) + static_cast<Scalar>(options.stiffness) * off * off;
    };
    Eigen::Index thinnest = -1;
    for (Eigen::Index i = 0; i < limb.line.arc.size(); ++i) {
        if (std::abs(limb.line.arc[i] - centre) > window || !(limb.line.thickness[i] > 0)) continue;
        if (thinnest < 0 || cost(i) < cost(thinnest)) thinnest = i;
    }
    if (thinnest < 0) return placement;
    Scalar at = limb.line.arc[thinnest];
    const bool has_neighbours = thinnest > 0 && thinnest + 1 < limb.line.arc.size() &&
                                limb.line.thickness[thinnest - 1] > 0 && limb.line.thickness[thinnest + 1] > 0;
    if (has_neighbours)
        at += core::least_of_parabola(cost(thinnest - 1), cost(thinnest), cost(thinnest + 1)) *
              (limb.line.arc[thinnest + 1] - limb.line.arc[thinnest]);
    placement.put(limb.joints[*found], point_on(limb, at));
    return placement;
}

template <typename Scalar>
Placement<Scalar> place_bend(Placement<Scalar> placement, const Limb<Scalar>& limb, const BendOptions& options,
                             const BoneLineOptions& bone_line) {
    for (std::size_t i = 1; i + 1 < limb.joints.size(); ++i) {
        const int joint = limb.joints[i];
        if (placement.role(joint) != JointRole::elbow && placement.role(joint) != JointRole::knee) continue;
        const Scalar here = arc_of(limb, i), inner = arc_of(limb, i - 1), outer = arc_of(limb, i + 1);
        const auto bones = bones_at_bend(limb, inner, here, outer, options, bone_line);
        const Vector3<Scalar> ratio = placement.at(joint);
        if (!bones || (bones->meeting - ratio).norm() > detail::farthest_meeting<Scalar> * (outer - inner)) continue;
        const Scalar weight = static_cast<Scalar>(options.weight) * bones->bent;
        placement.put(joint, ratio + weight * (bones->meeting - ratio));
    }
    return placement;
}

template <typename Scalar>
Placement<Scalar> place_girdle(Placement<Scalar> placement, const Limb<Scalar>& limb, const GirdleOptions& options,
                               const BoneLineOptions& bone_line) {
    if (limb.joints.size() < 2) return placement;
    const int top = limb.joints[0], next = limb.joints[1];
    const JointRole role = placement.role(top);
    if (role != JointRole::shoulder && role != JointRole::hip) return placement;
    const Scalar inner = arc_of(limb, 0), outer = arc_of(limb, 1);
    const auto line = fit_first_bone(limb, bone_line);
    const Scalar length = limb.from_tip[0] - limb.from_tip[1];
    const Vector3<Scalar> start = placement.at(next);
    const auto towards = [&](const Vector3<Scalar>& p) -> Vector3<Scalar> {
        return start + length * (p - start).normalized();
    };
    std::vector<Vector3<Scalar>> ways;
    if (line) ways.push_back(start - length * line->direction);
    if (limb.attachment < outer - detail::least_visible_bone<Scalar> * (outer - inner))
        ways.push_back(towards(point_on(limb, limb.attachment)));
    ways.push_back(towards(point_on(limb, inner)));
    placement.put(top, ways.front());

    const int anchor = role == JointRole::shoulder ? placement.find(JointRole::neck) : -1;
    if (anchor < 0 || is_bare(placement.skeleton_template(), anchor)) return placement;
    const Scalar rest = placement.rest_distance(top, anchor);
    const auto misfit = [&](const Vector3<Scalar>& p) { return std::abs((p - placement.at(anchor)).norm() - rest); };
    if (misfit(ways.front()) > static_cast<Scalar>(options.tolerance) * rest)
        placement.put(top, *std::min_element(ways.begin(), ways.end(),
                                             [&](const auto& p, const auto& q) { return misfit(p) < misfit(q); }));
    return placement;
}

namespace detail {

/// How a shoulder lies beside the trunk.
template <typename Scalar>
struct ShoulderHeight {
    Scalar trunk;       ///< from the hips to the neck
    Vector3<Scalar> up; ///< unit, along it
    Scalar missing;     ///< how much lower the shoulder is than people hold it, along it
};

/// That of a shoulder there, with its elbow where it is. Neck, head and hips must have been placed.
template <typename Scalar>
ShoulderHeight<Scalar> shoulder_height(const Placement<Scalar>& placement, const Limb<Scalar>& limb) {
    const Vector3<Scalar> neck = placement.at(placement.find(JointRole::neck));
    const Vector3<Scalar> shoulder = placement.at(limb.joints[0]), elbow = placement.at(limb.joints[1]);
    const Vector3<Scalar> trunk = neck - *placement.middle(JointRole::hip), up = trunk.stableNormalized();
    const Vector3<Scalar> from_neck = shoulder - neck;
    const Vector3<Scalar> outwards = (from_neck - from_neck.dot(up) * up).stableNormalized();
    const Scalar raised = (elbow - shoulder).stableNormalized().dot(up);
    const Vector3<Scalar> head = placement.at(placement.find(JointRole::head));
    const Scalar leant = (head - neck).stableNormalized().dot(outwards);
    const Scalar usual = trunk.norm() * core::usual_shoulder_height(raised, leant);
    return {trunk.norm(), up, usual - from_neck.dot(up)};
}

} // namespace detail

template <typename Scalar>
Placement<Scalar> place_shoulder_by_height(Placement<Scalar> placement, const Limb<Scalar>& limb,
                                           const GirdleOptions& options) {
    const bool is_arm = limb.joints.size() > 1 && placement.role(limb.joints[0]) == JointRole::shoulder;
    const bool has_trunk = placement.find(JointRole::neck) >= 0 && placement.find(JointRole::head) >= 0 &&
                           placement.middle(JointRole::hip).has_value();
    if (!is_arm || !has_trunk) return placement;
    const Vector3<Scalar> shoulder = placement.at(limb.joints[0]), elbow = placement.at(limb.joints[1]);
    auto height = detail::shoulder_height(placement, limb);
    if (std::abs(height.missing) > static_cast<Scalar>(options.farthest_height) * height.trunk) {
        const Vector3<Scalar> arm = shoulder + height.missing * height.up - elbow;
        placement.put(limb.joints[0], elbow + (shoulder - elbow).norm() * arm.stableNormalized());
        height = detail::shoulder_height(placement, limb);
    }
    const Scalar higher = static_cast<Scalar>(options.height_weight) * height.missing;
    const auto thickness = upper_arm_thickness(limb);
    if (thickness && std::abs(higher) > *thickness) return placement;
    placement.put(limb.joints[0], placement.at(limb.joints[0]) + higher * height.up);
    return placement;
}

namespace detail {

/// Of the places on a line so far from another place the one farther along it; where there are none the nearest one.
template <typename Scalar>
Vector3<Scalar> farther_place_at(const Line<Scalar>& line, const Vector3<Scalar>& centre, Scalar distance) {
    const Scalar nearest = (centre - line.point).dot(line.direction), off = distance_to(line, centre);
    const Scalar half = std::sqrt(std::max(Scalar(0), distance * distance - off * off));
    return line.point + (nearest + half) * line.direction;
}

} // namespace detail

template <typename Scalar>
Placement<Scalar> place_shoulder_by_trunk(Placement<Scalar> placement, const Limb<Scalar>& limb,
                                          const Vector3<Scalar>& fork, const BendOptions& bend,
                                          const BoneLineOptions& bone_line) {
    constexpr Scalar clearly = Scalar(1.4); // farther; 1.25 times at most on 96 registered bodies, however they bend
    if (limb.joints.size() < 3) return placement;
    const int shoulder = limb.joints[0], elbow = limb.joints[1], wrist = limb.joints[2];
    const int neck = placement.find(JointRole::neck);
    if (placement.role(shoulder) != JointRole::shoulder || neck < 0 || is_bare(placement.skeleton_template(), neck))
        return placement;
    const Scalar trunk = (placement.at(neck) - fork).norm() / placement.rest_distance(neck, 0);
    const Scalar breadth = trunk * placement.rest_distance(shoulder, neck);
    const auto is_far = [&](Scalar distance) { return distance > clearly * breadth; };
    if (!(trunk > 1 && is_far((placement.at(shoulder) - placement.at(neck)).norm()))) return placement;
    // An upper arm that shows too little of itself goes on as the forearm comes.
    const Vector3<Scalar> onwards = (placement.at(wrist) - placement.at(elbow)).stableNormalized();
    const Line<Scalar> line = fit_first_bone(limb, bone_line).value_or(Line<Scalar>{placement.at(elbow), onwards});
    if (is_far(distance_to(line, placement.at(neck)))) return placement; // no upper arm's
    const Vector3<Scalar> place = detail::farther_place_at(line, placement.at(neck), breadth);
    const Vector3<Scalar> moved = place - placement.at(shoulder);
    const Vector3<Scalar> upper = placement.at(elbow) - place, lower = placement.at(wrist) - placement.at(elbow);
    placement.put(shoulder, place);
    const Scalar bent = detail::degrees_between<Scalar>(upper.normalized(), lower.normalized());
    if (bent > static_cast<Scalar>(bend.full)) return placement;
    const Scalar fore = placement.rest_distance(elbow, wrist);
    placement.put(elbow, placement.at(elbow) + fore / (placement.rest_distance(shoulder, elbow) + fore) * moved);
    return placement;
}

} // namespace skelgen::refinement
