#pragma once

#include <skelgen/fitting/shape_gates.hpp>

#include <skelgen/core/geodesics.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/header_only.hpp>
#include <skelgen/embedding/missing_limbs.hpp>
#include <skelgen/refinement/end_points.hpp>

namespace skelgen::fitting {

SKELGEN_INLINE Failure too_compact_a_shape() {
    return {FailureReason::no_body, "no human body: too compact a shape for one with arms and legs"};
}

namespace detail {

inline Failure too_long_a_shape() {
    return {FailureReason::too_long, "no single human body: too thin and long a shape for one"};
}

/// An arm below its shoulder or a leg below its hip, by role and side; all that the trunk has in one; none for what may
/// lie in either.
enum class MainPart { none, trunk, arm, leg };

inline MainPart main_part(JointRole role) {
    switch (role) {
    case JointRole::waist:
    case JointRole::chest:
    case JointRole::neck:
        return MainPart::trunk;
    case JointRole::elbow:
    case JointRole::wrist:
    case JointRole::hand:
        return MainPart::arm;
    case JointRole::knee:
    case JointRole::ankle:
    case JointRole::foot:
        return MainPart::leg;
    default:
        return MainPart::none;
    }
}

} // namespace detail

template <typename Scalar>
std::optional<Failure> not_slender(Scalar diameter, double least) {
    constexpr Scalar most = Scalar(2.1);
    if (static_cast<double>(diameter) < least) return too_compact_a_shape();
    if (diameter > most) return detail::too_long_a_shape();
    return std::nullopt;
}

template <typename Scalar>
std::optional<Failure> too_compact(const Body<Scalar>& body) {
    constexpr Scalar least = Scalar(1.05), estimated = Scalar(0.95); // the latter of the diameter, at least
    const Scalar most = core::geodesic_diameter(body.graph) / estimated;
    return most < least ? std::optional(too_compact_a_shape()) : std::nullopt;
}

template <typename Scalar>
bool is_folded_body(const CurveSkeleton<Scalar>& curve, const embedding::Embedding& embedding, Scalar unmatched) {
    constexpr Scalar longer = Scalar(1.08), most_unmatched = Scalar(0.1);
    return embedding::distortion_per_pair(embedding) < well_fitted && unmatched < most_unmatched &&
           !not_slender(embedding::matched_diameter(curve, embedding) / longer, least_of_adults);
}

template <typename Scalar>
std::optional<Failure> not_single(const CurveSkeleton<Scalar>& curve, const embedding::Embedding& embedding) {
    if (embedding::unmatched_reach(curve, embedding) > arm_of_curve<Scalar>)
        return Failure{FailureReason::no_body,
                       "no single human body: a limb is left over; separate bodies that are joined to others"};
    return std::nullopt;
}

template <typename Scalar>
std::optional<Failure> not_all_matched(Scalar unmatched) {
    constexpr auto most = Scalar(0.4);
    if (unmatched > most)
        return Failure{
            FailureReason::no_body,
            "no single human body: much of its curve skeleton belongs to no limb; separate what is joined to it"};
    return std::nullopt;
}

template <typename Scalar>
std::optional<Failure> not_apart(const KinematicSkeleton<Scalar>& skeleton, const SkeletonTemplate& wanted) {
    constexpr Scalar least = Scalar(0.8); // of the joint's radius
    const std::size_t count = wanted.joints.size();
    for (std::size_t j = 0; j < count; ++j) {
        const TemplateJoint& joint = wanted.joints[j];
        const detail::MainPart limb = detail::main_part(joint.role);
        if (limb != detail::MainPart::arm && limb != detail::MainPart::leg) continue;
        for (std::size_t k = 0; k < count; ++k) {
            const TemplateJoint& other = wanted.joints[k];
            const detail::MainPart part = detail::main_part(other.role);
            if (!skeleton.joints[j].is_present || !skeleton.joints[k].is_present) continue;
            if (part == detail::MainPart::none || other.parent < 0 || (part == limb && other.side == joint.side))
                continue;
            const Vector3<Scalar>& from = skeleton.joints[static_cast<std::size_t>(other.parent)].position;
            const Vector3<Scalar>& place = skeleton.joints[j].position;
            const auto nearest = core::nearest_on_segment<Scalar, 3>(place, from, skeleton.joints[k].position);
            if (nearest.distance < least * skeleton.joints[j].radius)
                return Failure{FailureReason::no_match,
                               "no human body: two limbs lie along one; check that all stand free"};
        }
    }
    return std::nullopt;
}

} // namespace skelgen::fitting
