#pragma once

#include <skelgen/refinement/bone_line.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include <skelgen/core/geometry.hpp>

namespace skelgen::refinement {
namespace detail {

/// How far a section's centre may be from its bone's line, in median thicknesses of the limb: bones are that straight.
template <typename Scalar>
inline constexpr Scalar inlier_distance = Scalar(0.25);

/// Squared sine of the angle below which lines count as parallel: less than two degrees, at which the place where they
/// meet moves by thirty times what one of them is off.
template <typename Scalar>
inline constexpr Scalar least_squared_sine = Scalar(1e-3);

template <typename Scalar>
Scalar squared_distance_to(const Line<Scalar>& line, const Vector3<Scalar>& p) {
    return (p - line.point).cross(line.direction).squaredNorm();
}

/// Those of the points that lie near the line through two of them that most points are near (MSAC, TZ00, over all
/// pairs).
template <typename Scalar>
std::vector<Vector3<Scalar>> points_in_line(const std::vector<Vector3<Scalar>>& points, Scalar distance) {
    const Scalar farthest = distance * distance;
    Line<Scalar> best;
    Scalar least = std::numeric_limits<Scalar>::infinity();
    for (std::size_t i = 0; i < points.size(); ++i)
        for (std::size_t j = i + 1; j < points.size(); ++j) {
            if (!((points[j] - points[i]).norm() > distance)) continue;
            const Line<Scalar> line{points[i], (points[j] - points[i]).normalized()};
            Scalar cost = 0;
            for (const auto& p : points) cost += std::min(squared_distance_to(line, p), farthest);
            if (cost >= least) continue;
            least = cost;
            best = line;
        }
    if (!std::isfinite(least)) return {};
    std::vector<Vector3<Scalar>> near;
    for (const auto& p : points)
        if (squared_distance_to(best, p) < farthest) near.push_back(p);
    return near;
}

} // namespace detail

template <typename Scalar>
std::optional<Line<Scalar>> fit_bone(const Centreline<Scalar>& centreline, Scalar from, Scalar to,
                                     const BoneLineOptions& options) {
    const auto flatness = static_cast<Scalar>(options.flatness);
    std::vector<Vector3<Scalar>> points;
    std::vector<Scalar> thickness;
    for (Eigen::Index i = 0; i < centreline.points.rows(); ++i)
        if (centreline.arc[i] >= from && centreline.arc[i] <= to && centreline.area[i] > 0 &&
            centreline.flatness[i] < flatness) {
            points.emplace_back(core::point(centreline.points, i));
            thickness.push_back(centreline.thickness[i]);
        }
    if (points.size() < 3) return std::nullopt;
    const auto middle = thickness.begin() + static_cast<std::ptrdiff_t>(thickness.size() / 2);
    std::nth_element(thickness.begin(), middle, thickness.end());
    const auto near = detail::points_in_line(points, detail::inlier_distance<Scalar> * *middle);
    if (near.size() < 3) return std::nullopt;
    return core::principal_line(near);
}

template <typename Scalar>
std::optional<Line<Scalar>> fit_first_bone(const Limb<Scalar>& limb, const BoneLineOptions& options) {
    const Scalar inner = arc_of(limb, 0), outer = arc_of(limb, 1), at_joint = joint_part<Scalar> * (outer - inner);
    return fit_bone(limb.line, std::max(limb.attachment, inner + at_joint), outer - at_joint, options);
}

template <typename Scalar>
std::optional<Vector3<Scalar>> meeting_point(const Line<Scalar>& a, const Line<Scalar>& b) {
    const Scalar c = a.direction.dot(b.direction), sine_squared = 1 - c * c;
    if (sine_squared < detail::least_squared_sine<Scalar>) return std::nullopt;
    const Vector3<Scalar> between = b.point - a.point;
    const Scalar s = (between.dot(a.direction) - c * between.dot(b.direction)) / sine_squared;
    const Scalar t = (c * between.dot(a.direction) - between.dot(b.direction)) / sine_squared;
    return Vector3<Scalar>(Scalar(0.5) * (a.point + s * a.direction + b.point + t * b.direction));
}

} // namespace skelgen::refinement
