#pragma once

#include <vector>

#include <skelgen/core/mesh.hpp>

namespace skelgen::core {

/// A straight line; `direction` has unit length.
template <typename Scalar = double>
struct Line {
    Vector3<Scalar> point = Vector3<Scalar>::Zero();
    Vector3<Scalar> direction = Vector3<Scalar>::Zero();
};

/// A line laid through points.
template <typename Scalar = double>
struct FittedLine : Line<Scalar> {
    Scalar roughness =
        0; ///< how far the points are off it in the direction across in which they are most, root mean square
};

/// How far a place is from a line.
template <typename Scalar>
[[nodiscard]] Scalar distance_to(const Line<Scalar>& line, const Vector3<Scalar>& place) {
    return (place - line.point).cross(line.direction).norm();
}

/// Least squares line through two points or more, pointing from the first towards the last one: through their mean,
/// along their first principal axis. O(k).
template <typename Scalar>
[[nodiscard]] FittedLine<Scalar> principal_line(const std::vector<Vector3<Scalar>>& points);

} // namespace skelgen::core

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/core/impl/line.hpp>
#endif
