#pragma once

#include <cmath>

#include <Eigen/Geometry>

#include <skelgen/core/mesh.hpp>

namespace skelgen::core {

/// The least rotation that takes the direction of `from` to that of `to`; of opposite ones a half turn about any axis
/// across them. Both of any length but 0. As `Eigen::Quaternion::FromTwoVectors` without its singular value
/// decomposition, which is for opposite directions alone and takes a compiler ten seconds. O(1).
template <typename Scalar>
[[nodiscard]] Eigen::Quaternion<Scalar> shortest_turn(const Vector3<Scalar>& from, const Vector3<Scalar>& to) {
    const Vector3<Scalar> a = from.normalized(), b = to.normalized();
    const Scalar cosine = b.dot(a);
    if (cosine < Scalar(-1) + Eigen::NumTraits<Scalar>::dummy_precision()) {
        const Vector3<Scalar> axis = a.unitOrthogonal();
        return Eigen::Quaternion<Scalar>(Scalar(0), axis[0], axis[1], axis[2]);
    }
    const Scalar twice = std::sqrt((Scalar(1) + cosine) * Scalar(2)); // the cosine of half the angle, twice
    const Vector3<Scalar> axis = a.cross(b) * (Scalar(1) / twice);
    return Eigen::Quaternion<Scalar>(twice * Scalar(0.5), axis[0], axis[1], axis[2]);
}

} // namespace skelgen::core
