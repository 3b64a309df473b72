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

/// A place on a polyline of two points or more: between its points `next` - 1 and `next`.
template <typename Scalar>
struct PolylinePlace {
    Eigen::Index next = 1;
    Scalar along = 0; ///< 0 at the former, 1 at the latter
};

/// The place at arc length `s` (clamped to the ends) of a polyline with arc lengths `arc`, k of two or more. O(log k).
template <typename Scalar>
[[nodiscard]] PolylinePlace<Scalar> place_at(const Eigen::Matrix<Scalar, Eigen::Dynamic, 1>& arc, Scalar s) {
    const Scalar* begin = arc.data();
    const Eigen::Index i = std::clamp<Eigen::Index>(std::upper_bound(begin, begin + arc.size(), s) - begin, 1,
                                                    std::max<Eigen::Index>(arc.size() - 1, 1));
    const Scalar length = arc[i] - arc[i - 1];
    return {i, length > 0 ? std::clamp((s - arc[i - 1]) / length, Scalar(0), Scalar(1)) : Scalar(0)};
}

/// The point at arc length `s` (clamped to the ends) of a polyline with arc lengths `arc`. O(log k).
template <typename Scalar>
[[nodiscard]] Vector3<Scalar> point_at(const Points<Scalar>& line, const Eigen::Matrix<Scalar, Eigen::Dynamic, 1>& arc,
                                       Scalar s) {
    if (line.rows() == 1) return line.row(0);
    const auto [next, along] = place_at(arc, s);
    return ((1 - along) * line.row(next - 1) + along * line.row(next)).transpose();
}

/// The value at arc length `s` of what is known at the points of a polyline, k values. O(log k).
template <typename Scalar>
[[nodiscard]] Scalar value_at(const Eigen::Matrix<Scalar, Eigen::Dynamic, 1>& values,
                              const Eigen::Matrix<Scalar, Eigen::Dynamic, 1>& arc, Scalar s) {
    if (values.size() == 1) return values[0];
    const auto [next, along] = place_at(arc, s);
    return (1 - along) * values[next - 1] + along * values[next];
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
