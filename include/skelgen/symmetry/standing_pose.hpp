#pragma once

#include <skelgen/core/mesh.hpp>

namespace skelgen::symmetry {

/// One leg as its bones' directions, any length: hip to knee, knee to ankle, ankle to toe.
template <typename Scalar = double>
struct LegBones {
    Vector3<Scalar> thigh, calf, foot;
};

/// Where the foot points when the leg is brought into the standing pose (LF20 section 3.3), a unit vector: `up` and the
/// hip-to-hip direction `across` (either sense) are orthogonal unit vectors. A leg bent by less than `straight` (sine
/// of the angle; 0.25 is 14 degrees) is turned by its foot instead of its knee: in so straight a leg, joints that are
/// a few centimetres off turn the plane of thigh and calf at random.
template <typename Scalar>
[[nodiscard]] Vector3<Scalar> standing_foot_direction(LegBones<Scalar> leg, const Vector3<Scalar>& up,
                                                      const Vector3<Scalar>& across, Scalar straight = Scalar(0.25));

namespace detail {

/// `v` without its part along that unit `direction`.
template <typename Scalar>
[[nodiscard]] Vector3<Scalar> without_component(const Vector3<Scalar>& v, const Vector3<Scalar>& direction) {
    return v - v.dot(direction) * direction;
}

} // namespace detail
} // namespace skelgen::symmetry

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/symmetry/impl/standing_pose.hpp>
#endif
