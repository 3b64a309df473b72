#pragma once

#include <functional>
#include <random>
#include <vector>

#include <skelgen/synth/tubes.hpp>

#include "primitives.hpp"

/// Lines that tubes are made along.
namespace skelgen::synth {

inline constexpr double pi = 3.14159265358979323846;

using Line = std::function<Vec3(double)>; ///< over 0 to 1
using Width = std::function<double(double)>;

[[nodiscard]] Width even(double radius);
[[nodiscard]] Width tapering(double from, double to);
/// Through the radii, each at a multiple of 1 / (n - 1); at least two.
[[nodiscard]] Width between(std::vector<double> radii);

[[nodiscard]] Line straight(const Vec3& a, const Vec3& b);
/// A smooth line through the points (Catmull and Rom's spline), each at a multiple of 1 / (n - 1); at least two.
[[nodiscard]] Line through(std::vector<Vec3> points);

/// A tube along a line, with a point at each of the `stops`.
[[nodiscard]] TubeStroke trace(const Line& line, const Width& radius, const std::vector<double>& stops = {});
/// A tube with elliptical sections; `wide` is made perpendicular to the line.
[[nodiscard]] TubeStroke trace_flat(const Line& line, const Width& radius, double aspect, const Line& wide);
/// The tube, rounded off where it joins those before it.
[[nodiscard]] TubeStroke soft(TubeStroke stroke);

/// The point of a tube's line that is nearest to a place: where others can be joined to it.
[[nodiscard]] Vec3 joint_near(const TubeStroke& stroke, const Vec3& place);

/// Between 0 and 1; the same on every machine.
[[nodiscard]] double uniform(std::mt19937_64& random);

} // namespace skelgen::synth
