#pragma once

#include <cmath>
#include <numbers>

#include <skelgen/core/mesh.hpp>

namespace skelgen::symmetry {

/// One leg as its bones' directions, any length: hip to knee, knee to ankle, ankle to toe.
template <typename Scalar = double>
struct LegBones {
    Vector3<Scalar> thigh, calf, foot;
};

namespace detail {

/// `v` without its part along that unit `direction`.
template <typename Scalar>
[[nodiscard]] Vector3<Scalar> without_component(const Vector3<Scalar>& v, const Vector3<Scalar>& direction) {
    return v - v.dot(direction) * direction;
}

/// The leg with its foot, and its thigh and calf where it says so, rotated by `angle` about that unit `axis`.
template <typename Scalar>
LegBones<Scalar> rotated(LegBones<Scalar> leg, Scalar angle, const Vector3<Scalar>& axis, bool thigh, bool calf) {
    const Eigen::AngleAxis<Scalar> rotation(angle, axis);
    if (thigh) leg.thigh = rotation * leg.thigh;
    if (calf) leg.calf = rotation * leg.calf;
    leg.foot = rotation * leg.foot;
    return leg;
}

/// Angle about `axis` from `from` to `to`, both projected to the plane normal to `axis`; in (-pi, pi].
template <typename Scalar>
Scalar signed_angle(const Vector3<Scalar>& from, const Vector3<Scalar>& to, const Vector3<Scalar>& axis) {
    return std::atan2(axis.dot(from.cross(to)), without_component(from, axis).dot(without_component(to, axis)));
}

/// The smaller of the two angles that bring `from` onto the line of `to`: at most 90 degrees.
template <typename Scalar>
Scalar angle_to_line(const Vector3<Scalar>& from, const Vector3<Scalar>& to, const Vector3<Scalar>& axis) {
    const Scalar angle = signed_angle(from, to, axis);
    constexpr auto half_turn = std::numbers::pi_v<Scalar>;
    return angle > half_turn / 2 ? angle - half_turn : angle < -half_turn / 2 ? angle + half_turn : angle;
}

} // namespace detail

/// Where the foot points when the leg is brought into the standing pose (LF20 section 3.3), a unit vector: `up` and the
/// hip-to-hip direction `across` (either sense) are orthogonal unit vectors. A leg bent by less than `straight` (sine
/// of the angle; 0.25 is 14 degrees) is turned by its foot instead of its knee: in so straight a leg, joints that are
/// a few centimetres off turn the plane of thigh and calf at random.
template <typename Scalar>
Vector3<Scalar> standing_foot_direction(LegBones<Scalar> leg, const Vector3<Scalar>& up, const Vector3<Scalar>& across,
                                        Scalar straight = Scalar(0.25)) {
    const Vector3<Scalar> bend = leg.thigh.normalized().cross(leg.calf.normalized());
    if (bend.norm() > straight) {
        leg = detail::rotated(leg, detail::angle_to_line(bend, across, up), up, true, true);
        // Foot normal to `across`: its component across, seen along the calf, turned away.
        const Vector3<Scalar> calf = leg.calf.normalized();
        const Vector3<Scalar> hinge = calf.cross(leg.foot);
        leg = detail::rotated(leg, detail::angle_to_line(hinge, across, calf), calf, false, false);
    } else {
        const Vector3<Scalar> hinge = leg.thigh.cross(leg.foot);
        leg = detail::rotated(leg, detail::angle_to_line(hinge, across, up), up, true, true);
    }
    const Vector3<Scalar> down = -up;
    leg = detail::rotated(leg, detail::signed_angle(leg.thigh, down, across), across, true, true);
    leg = detail::rotated(leg, detail::signed_angle(leg.calf, down, across), across, false, true);
    return leg.foot.normalized();
}

} // namespace skelgen::symmetry
