#pragma once

#include <skelgen/symmetry/sides.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>

#include <skelgen/core/geometry.hpp>
#include <skelgen/symmetry/impl/standing_pose.hpp>
#include <skelgen/symmetry/joints_by_role.hpp>
#include <skelgen/symmetry/sides_table.hpp>

namespace skelgen::symmetry {
namespace detail {

template <typename Scalar>
std::optional<LegBones<Scalar>> leg_bones(const JointsByRole<Scalar>& joints, Side side) {
    using enum JointRole;
    if (!joints.find(knee, side)) return std::nullopt;
    const Vector3<Scalar> knee_at = joints.get(knee, side);
    const Vector3<Scalar> ankle_at = joints.find(ankle, side).value_or(knee_at);
    const auto foot_at = joints.find(foot, side);
    const Vector3<Scalar> toe = foot_at ? joints.tip(foot, side).value_or(*foot_at) : ankle_at;
    return LegBones<Scalar>{knee_at - joints.get(hip, side), ankle_at - knee_at, toe - ankle_at};
}

/// Where the axis of a bent elbow points: left, times the sine of the bend. None without elbow, shoulder or forearm.
template <typename Scalar>
std::optional<Vector3<Scalar>> elbow_axis(const JointsByRole<Scalar>& joints, Side side) {
    using enum JointRole;
    const auto shoulder_at = joints.find(shoulder, side), elbow_at = joints.find(elbow, side);
    if (!shoulder_at || !elbow_at) return std::nullopt;
    auto hand_at = joints.find(wrist, side);
    if (!hand_at) hand_at = joints.find(hand, side);
    if (!hand_at) return std::nullopt;
    // The forearm folds forwards: forearm x upper arm points left.
    return (*hand_at - *elbow_at).normalized().cross((*elbow_at - *shoulder_at).normalized());
}

/// From the right to the left arm, by the first joint that both have.
template <typename Scalar>
Vector3<Scalar> between_arms(const JointsByRole<Scalar>& joints) {
    using enum JointRole;
    for (const JointRole role : {shoulder, elbow, wrist})
        if (const auto left = joints.find(role, Side::left), right = joints.find(role, Side::right); left && right)
            return *left - *right;
    return joints.get(hand, Side::left) - joints.get(hand, Side::right);
}

/// The joint that ends up under the name of template joint `j`.
template <typename Scalar>
int source_of(int j, const SkeletonTemplate& skeleton_template, const SidesDecision<Scalar>& sides) {
    const BodyPart part = part_of(skeleton_template.joint(j).role);
    const bool swapped = part == BodyPart::leg ? sides.swap_legs : part == BodyPart::arm && sides.swap_arms;
    const int other = swapped ? counterpart(skeleton_template, j) : -1;
    return other >= 0 ? other : j;
}

inline std::string doubt_of_sides(const std::vector<SideVote>& votes) {
    std::string against;
    for (const SideVote& vote : votes)
        if (vote.strength < 0) against += (against.empty() ? "" : ", ") + vote.witness;
    return "left and right may be exchanged: " + (against.empty()
                                                      ? "feet, knees, elbows and head hardly tell them"
                                                      : "the witnesses disagree (against: " + against + ")");
}

} // namespace detail

SKELGEN_INLINE std::string_view to_string(SideWitness witness) {
    constexpr std::array<std::string_view, side_witness_count> names{"foot", "knee", "elbow", "head", "sole", "face"};
    return names[static_cast<std::size_t>(witness)];
}

SKELGEN_INLINE std::vector<SideVote> votes_of(const SideEvidence& evidence) {
    static_assert(side_weights.size() == side_witness_count && side_limits.size() == side_witness_count);
    std::vector<SideVote> out;
    for (std::size_t w = 0; w < side_witness_count; ++w)
        if (evidence.values[w] != 0)
            out.push_back({std::string(to_string(static_cast<SideWitness>(w))),
                           side_weights[w] * std::clamp(evidence.values[w], -side_limits[w], side_limits[w])});
    return out;
}

template <typename Scalar>
Outcome<SidesDecision<Scalar>> decide_sides(const refinement::RefinedJoints<Scalar>& joints,
                                            const SkeletonTemplate& skeleton_template,
                                            const SurfaceFront<Scalar>& surface) {
    using enum JointRole;
    const detail::JointsByRole<Scalar> by_role(joints, skeleton_template);
    const Vector3<Scalar> left_hip = by_role.get(hip, Side::left), right_hip = by_role.get(hip, Side::right);
    const Vector3<Scalar> hips_middle = Scalar(0.5) * (left_hip + right_hip), hips = left_hip - right_hip;
    const Vector3<Scalar> spine = by_role.find(waist).value_or(by_role.get(chest)) - hips_middle;
    const Vector3<Scalar> up = spine.normalized();
    const Vector3<Scalar> across = detail::without_component(hips, up).normalized();
    if (!(spine.norm() > 0) || !(across.norm() > Scalar(0.5))) // a unit vector, or zero
        return Failure{Refusal::flat_trunk,
                       "no human body: its trunk or its hips have no extent; check that it was not scaled flat"};

    SidesDecision<Scalar> out;
    // Does a direction that ought to be the left one say that `across` points left?
    const auto hear = [&](SideWitness witness, const Vector3<Scalar>& left) {
        out.evidence[witness] += static_cast<double>(left.dot(across));
    };
    Vector3<Scalar> forward = Vector3<Scalar>::Zero();
    for (const Side side : {Side::left, Side::right}) {
        const auto leg = detail::leg_bones(by_role, side);
        if (leg && by_role.find(foot, side)) {
            const Vector3<Scalar> standing = detail::without_component(standing_foot_direction(*leg, up, across), up);
            forward += standing;
            hear(SideWitness::foot, up.cross(standing)); // up x forward is left
        }
        // The calf folds backwards: thigh x calf points left.
        if (leg) hear(SideWitness::knee, leg->thigh.normalized().cross(leg->calf.normalized()));
        if (const auto axis = detail::elbow_axis(by_role, side)) hear(SideWitness::elbow, *axis);
    }
    if (joints.head) hear(SideWitness::head, up.cross(joints.head->forward) * joints.head->frontness);
    hear(SideWitness::sole, up.cross(surface.sole));
    hear(SideWitness::face, up.cross(surface.face));
    double log_odds = 0;
    for (const SideVote& vote : votes_of(out.evidence)) log_odds += vote.strength;
    out.swap_legs = log_odds < 0;
    if (out.swap_legs)
        for (double& value : out.evidence.values) value = -value;
    out.confidence = 2 * core::logistic(std::abs(log_odds)) - 1;

    // Where the feet say nothing, or are outvoted, the hips decide; where they speak, they know better than hips that a
    // deep crouch hides. Half of one foot that points straight ahead is speaking.
    const Vector3<Scalar> decided = out.swap_legs ? Vector3<Scalar>(-across) : across;
    Vector3<Scalar> left = up.cross(forward);
    if (!(left.norm() > Scalar(0.5)) || left.dot(decided) < 0) left = decided;
    out.frame.origin = by_role.get(pelvis);
    out.frame.up = up;
    out.frame.left = detail::without_component(left, up).normalized();
    out.frame.forward = out.frame.left.cross(up);
    out.swap_arms = detail::between_arms(by_role).dot(left) < 0;
    return out;
}

template <typename Scalar>
KinematicSkeleton<Scalar> assemble(const refinement::RefinedJoints<Scalar>& joints,
                                   const SkeletonTemplate& skeleton_template, const SidesDecision<Scalar>& sides) {
    KinematicSkeleton<Scalar> out;
    out.template_name = skeleton_template.name;
    for (int j = 0; j < static_cast<int>(skeleton_template.joints.size()); ++j) {
        const TemplateJoint& joint = skeleton_template.joint(j);
        const int source = detail::source_of(j, skeleton_template, sides);
        out.joints.push_back({joint.name, joint.parent, core::point(joints.positions, source), Scalar(0)});
        if (!detail::is_present(joints, source)) {
            out.joints.back().is_present = false;
            out.joints.back().confidence = 0;
            out.quality.warnings.push_back("joint " + joint.name + " is missing: the surface ends before it");
        }
        for (const auto& [end, tip] : joints.tips)
            if (end == source) out.end_points.emplace_back(end_point_name(skeleton_template, joint), tip);
    }
    out.frame = sides.frame;
    out.quality.sides_confidence = sides.confidence;
    out.quality.side_votes = votes_of(sides.evidence);
    constexpr double doubtful = 0.5; // below, they are right in less than three of four cases
    if (sides.confidence < doubtful) out.quality.warnings.push_back(detail::doubt_of_sides(out.quality.side_votes));
    return out;
}

} // namespace skelgen::symmetry
