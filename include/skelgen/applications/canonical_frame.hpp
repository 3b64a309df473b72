#pragma once

#include <Eigen/Geometry>

#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/core/mesh.hpp>

namespace skelgen::applications {

/// A rotation and then a translation: no scale, no mirroring.
template <typename Scalar = double>
struct RigidMotion {
    Eigen::Quaternion<Scalar> rotation = Eigen::Quaternion<Scalar>::Identity();
    Vector3<Scalar> translation = Vector3<Scalar>::Zero();

    [[nodiscard]] Vector3<Scalar> operator()(const Vector3<Scalar>& p) const { return rotation * p + translation; }
};

/// Right-handed axes as a rotation from x, y and z to them: y along `along` exactly, x as near to `across` as that
/// allows. None of the two may be zero, and they may not be parallel.
template <typename Scalar>
[[nodiscard]] Eigen::Quaternion<Scalar> axes_along(const Vector3<Scalar>& along, const Vector3<Scalar>& across) {
    const Vector3<Scalar> y = along.normalized(), x = (across - across.dot(y) * y).normalized();
    Eigen::Matrix<Scalar, 3, 3> columns;
    columns << x, y, x.cross(y);
    return Eigen::Quaternion<Scalar>(columns).normalized();
}

/// The proper rotation that turns three directions of a body to x, y and z: `up` is turned to +y exactly, `left`
/// as nearly to +x as that allows; the body then faces +z (glTF's convention). None of the two may be zero, and they
/// may not be parallel.
template <typename Scalar>
[[nodiscard]] Eigen::Quaternion<Scalar> rotation_to_canonical(const Vector3<Scalar>& left, const Vector3<Scalar>& up) {
    return axes_along(up, left).conjugate();
}

/// As above, of a skeleton's own frame.
template <typename Scalar>
[[nodiscard]] Eigen::Quaternion<Scalar> rotation_to_canonical(const BodyFrame<Scalar>& frame) {
    return rotation_to_canonical(frame.left, frame.up);
}

} // namespace skelgen::applications
