#pragma once

#include <optional>

#include <skelgen/core/mesh.hpp>
#include <skelgen/refinement/centreline.hpp>

namespace skelgen::detail {

/// A straight line; `direction` has unit length.
struct Line {
    Vector3<double> point;
    Vector3<double> direction;
};

/// The line through the centres of the cylindrical sections of `centreline` between arc lengths `from` < `to`, pointing
/// towards larger arc length; none with fewer than three of them.
std::optional<Line> fit_bone(const Centreline& centreline, double from, double to, double flatness);

/// Middle of the common perpendicular of two lines; none when they are nearly parallel.
std::optional<Vector3<double>> meeting_point(const Line& a, const Line& b);

} // namespace skelgen::detail
