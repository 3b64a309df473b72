#pragma once

#include <limits>

#include <Eigen/Geometry>

#include <skelgen/core/geometry.hpp>

namespace skelgen::core {

/// Barycentric coordinates of the place on a triangle that is nearest to `p`; the triangle may be degenerate.
template <typename Scalar>
[[nodiscard]] Vector3<Scalar> nearest_share(const Vector3<Scalar>& p, const Vector3<Scalar>& a,
                                            const Vector3<Scalar>& b, const Vector3<Scalar>& c) {
    const Vector3<Scalar> ab = b - a, ac = c - a, normal = ab.cross(ac);
    const Scalar squared = normal.squaredNorm();
    if (squared > 0) {
        const Scalar u = normal.dot((p - a).cross(ac)) / squared, v = normal.dot(ab.cross(p - a)) / squared;
        if (u >= 0 && v >= 0 && u + v <= 1) return {1 - u - v, u, v};
    }
    const Vector3<Scalar> corners[3] = {a, b, c};
    Vector3<Scalar> best = Vector3<Scalar>::UnitX();
    Scalar least = std::numeric_limits<Scalar>::infinity();
    for (int k = 0; k < 3; ++k) {
        const int next = (k + 1) % 3;
        const auto near = nearest_on_segment<Scalar, 3>(p, corners[k], corners[next]);
        if (!(near.distance < least)) continue;
        least = near.distance;
        best = Vector3<Scalar>::Zero();
        best[k] = 1 - near.along;
        best[next] += near.along;
    }
    return best;
}

} // namespace skelgen::core
