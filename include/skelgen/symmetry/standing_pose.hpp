#pragma once

#include <algorithm>
#include <cmath>

#include <skelgen/core/mesh.hpp>

namespace skelgen {

/// One leg as its bones' directions, any length: hip to knee, knee to ankle, ankle to toe.
template <typename Scalar = double>
struct LegBones {
    Vector3<Scalar> thigh, calf, foot;
};

namespace detail {

template <typename Scalar>
Vector3<Scalar> without_component(const Vector3<Scalar>& v, const Vector3<Scalar>& direction) {
    return v - v.dot(direction) * direction;
}

template <typename Scalar>
void rotate(LegBones<Scalar>& leg, Scalar angle, const Vector3<Scalar>& axis, bool thigh, bool calf) {
    const Eigen::AngleAxis<Scalar> rotation(angle, axis);
    if (thigh) leg.thigh = rotation * leg.thigh;
    if (calf) leg.calf = rotation * leg.calf;
    leg.foot = rotation * leg.foot;
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
    const Scalar half_turn = static_cast<Scalar>(EIGEN_PI);
    return angle > half_turn / 2 ? angle - half_turn : angle < -half_turn / 2 ? angle + half_turn : angle;
}

} // namespace detail

/// Where the foot points when the leg is brought into the standing pose (LF20 section 3.3): `up` and the hip-to-hip
/// direction `across` (either sense) are orthogonal unit vectors. A leg bent by less than `straight` (sine of the
/// angle) is turned by its foot instead of its knee.
template <typename Scalar>
[[nodiscard]] Vector3<Scalar> standing_foot_direction(LegBones<Scalar> leg, const Vector3<Scalar>& up,
                                                      const Vector3<Scalar>& across, Scalar straight = Scalar(0.25)) {
    const Vector3<Scalar> bend = leg.thigh.normalized().cross(leg.calf.normalized());
    if (bend.norm() > straight) {
        detail::rotate(leg, detail::angle_to_line(bend, across, up), up, true, true);
        // Foot normal to `across`: its component across, seen along the calf, turned away.
        const Vector3<Scalar> calf = leg.calf.normalized();
        const Vector3<Scalar> hinge = calf.cross(leg.foot);
        detail::rotate(leg, detail::angle_to_line(hinge, across, calf), calf, false, false);
    } else {
        const Vector3<Scalar> hinge = leg.thigh.cross(leg.foot);
        detail::rotate(leg, detail::angle_to_line(hinge, across, up), up, true, true);
    }
    const Vector3<Scalar> down = -up;
    detail::rotate(leg, detail::signed_angle(leg.thigh, down, across), across, true, true);
    detail::rotate(leg, detail::signed_angle(leg.calf, down, across), across, false, true);
    return leg.foot.normalized();
}

} // namespace skelgen
