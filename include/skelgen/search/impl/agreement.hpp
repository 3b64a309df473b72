#pragma once

#include <algorithm>
#include <cmath>

#include <skelgen/core/mesh.hpp>
#include <skelgen/surface/body.hpp>

namespace skelgen::search {

/// A body's largest extent along its principal axes, which are its coordinates' axes, in the input's unit: what
/// agreement() goes by. O(vertices).
template <typename Scalar>
[[nodiscard]] double extent_of(const Body<Scalar>& body) {
    const Points<Scalar>& vertices = body.mesh.vertices;
    return static_cast<double>(body.similarity.scale *
                               (vertices.colwise().maxCoeff() - vertices.colwise().minCoeff()).maxCoeff());
}

/// How far two skeletons of one template agree: 1 where all joints lie on each other, 0.37 where they are apart by a
/// twentieth of `extent` in the mean, 0 where they have little in common. One row per joint, not finite where it is
/// absent: only joints that both have are compared, and one that is farther than 0.3 of the extent counts as that far.
/// 0 where both have less than half of the joints. O(joints).
inline double agreement(const Points<double>& a, const Points<double>& b, double extent) {
    constexpr double near = 0.05, farthest = 0.3; // of the extent
    double sum = 0;
    Eigen::Index both = 0;
    for (Eigen::Index j = 0; j < a.rows(); ++j) {
        const double distance = (a.row(j) - b.row(j)).norm() / extent;
        if (!std::isfinite(distance)) continue;
        sum += std::min(distance, farthest);
        ++both;
    }
    if (2 * both < a.rows()) return 0;
    const double mean = sum / static_cast<double>(both);
    return std::exp(-mean * mean / (near * near));
}

} // namespace skelgen::search
