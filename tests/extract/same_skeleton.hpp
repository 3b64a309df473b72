#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <skelgen/core/geometry.hpp>
#include <skelgen/extract.hpp>

#include "catch.hpp"
#include "mesh_changes.hpp"

namespace skelgen::test {

/// How far joints may move, relative to the geodesic diameter, when the body is moved, turned, scaled or stored in
/// another order: what docs/results.md promises.
inline constexpr double by_motion = 1e-10;

/// And when it is given in single precision.
inline constexpr double by_rounding = 1e-4;

/// Two extractions of the same body compared: joints and end points.
struct Difference {
    double joint = 0;       ///< largest distance between the same joint in both, relative to the geodesic diameter
    double end = 0;         ///< the same of the end points
    std::string where;      ///< of the largest of both
    double frame_angle = 0; ///< largest between the same direction in both, degrees
};

/// `actual` of the body that `motion` moved, against `expected` of the body itself.
template <typename Scalar>
Difference difference(const Extraction<Scalar>& actual, const Extraction<double>& expected, const Motion& motion = {}) {
    Difference out;
    const auto compare = [&](double& largest, const std::string& name, const Vector3<Scalar>& there,
                             const Vector3<double>& here) {
        const Vector3<double> undone = motion.undo(there.template cast<double>());
        const double distance = (undone - here).norm() / expected.geodesic_diameter;
        if (distance > std::max(out.joint, out.end)) out.where = name;
        largest = std::max(largest, distance);
    };
    REQUIRE(actual.skeleton.joints.size() == expected.skeleton.joints.size());
    REQUIRE(actual.skeleton.end_points.size() == expected.skeleton.end_points.size());
    for (std::size_t j = 0; j < expected.skeleton.joints.size(); ++j)
        compare(out.joint, expected.skeleton.joints[j].name, actual.skeleton.joints[j].position,
                expected.skeleton.joints[j].position);
    for (std::size_t e = 0; e < expected.skeleton.end_points.size(); ++e)
        compare(out.end, expected.skeleton.end_points[e].first, actual.skeleton.end_points[e].second,
                expected.skeleton.end_points[e].second);
    const auto turn = [&](const Vector3<Scalar>& there, const Vector3<double>& here) {
        const Vector3<double> undone = motion.rotation.transpose() * there.template cast<double>();
        const double angle = std::atan2(undone.cross(here).norm(), undone.dot(here)) * 180 / std::numbers::pi;
        out.frame_angle = std::max(out.frame_angle, angle);
    };
    turn(actual.skeleton.frame.left, expected.skeleton.frame.left);
    turn(actual.skeleton.frame.forward, expected.skeleton.frame.forward);
    turn(actual.skeleton.frame.up, expected.skeleton.frame.up);
    return out;
}

} // namespace skelgen::test
