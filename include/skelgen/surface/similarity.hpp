#pragma once

#include <skelgen/core/mesh.hpp>

namespace skelgen {

/// A rotation, a uniform scale and a translation: canonical = rotation * (input - origin) / scale.
template <typename Scalar = double>
struct Similarity {
    Eigen::Matrix<Scalar, 3, 3> rotation = Eigen::Matrix<Scalar, 3, 3>::Identity();
    Vector3<Scalar> origin = Vector3<Scalar>::Zero();
    Scalar scale = 1;

    [[nodiscard]] Vector3<Scalar> to_canonical(const Vector3<Scalar>& p) const {
        const Vector3<Scalar> moved = p - origin, turned = rotation * moved;
        return turned / scale;
    }
    [[nodiscard]] Vector3<Scalar> to_input(const Vector3<Scalar>& p) const {
        return direction_to_input(p) * scale + origin;
    }
    [[nodiscard]] Vector3<Scalar> direction_to_input(const Vector3<Scalar>& d) const {
        return rotation.transpose() * d;
    }
    /// This one, and then another.
    [[nodiscard]] Similarity then(const Similarity& next) const {
        return {next.rotation * rotation, to_input(next.origin), next.scale * scale};
    }
};

} // namespace skelgen
