#pragma once

#include <algorithm>
#include <cmath>

#include <Eigen/Core>

#include <skelgen/core/mesh.hpp>

namespace skelgen::core {

/// Arc length from the first point to each point of a polyline, k entries.
template <typename Scalar>
[[nodiscard]] Eigen::Matrix<Scalar, Eigen::Dynamic, 1> arc_lengths(const Points<Scalar>& line) {
    Eigen::Matrix<Scalar, Eigen::Dynamic, 1> arc = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>::Zero(line.rows());
    for (Eigen::Index i = 1; i < line.rows(); ++i) arc[i] = arc[i - 1] + (line.row(i) - line.row(i - 1)).norm();
    return arc;
}

/// The point at arc length `s` (clamped to the ends) of a polyline with arc lengths `arc`. O(log k).
template <typename Scalar>
[[nodiscard]] Vector3<Scalar> point_at(const Points<Scalar>& line, const Eigen::Matrix<Scalar, Eigen::Dynamic, 1>& arc,
                                       Scalar s) {
    const Scalar* begin = arc.data();
    const Eigen::Index i = std::clamp<Eigen::Index>(std::upper_bound(begin, begin + arc.size(), s) - begin, 1,
                                                    std::max<Eigen::Index>(arc.size() - 1, 1));
    if (line.rows() == 1) return line.row(0);
    const Scalar length = arc[i] - arc[i - 1];
    const Scalar t = length > 0 ? std::clamp((s - arc[i - 1]) / length, Scalar(0), Scalar(1)) : Scalar(0);
    return ((1 - t) * line.row(i - 1) + t * line.row(i)).transpose();
}

/// The same polyline with points evenly spaced by about `step`; both ends are kept.
template <typename Scalar>
[[nodiscard]] Points<Scalar> resample(const Points<Scalar>& line, Scalar step) {
    const auto arc = arc_lengths(line);
    const auto pieces = std::max<Eigen::Index>(1, static_cast<Eigen::Index>(std::lround(arc[arc.size() - 1] / step)));
    Points<Scalar> out(pieces + 1, 3);
    for (Eigen::Index i = 0; i <= pieces; ++i)
        out.row(i) =
            point_at(line, arc, arc[arc.size() - 1] * static_cast<Scalar>(i) / static_cast<Scalar>(pieces)).transpose();
    return out;
}

/// Unit tangent at point `i`, from the points up to `reach` places before and after.
template <typename Scalar>
[[nodiscard]] Vector3<Scalar> tangent_at(const Points<Scalar>& line, Eigen::Index i, Eigen::Index reach) {
    const Eigen::Index before = std::max<Eigen::Index>(i - reach, 0), after = std::min(i + reach, line.rows() - 1);
    return (line.row(after) - line.row(before)).transpose().normalized();
}

} // namespace skelgen::core
