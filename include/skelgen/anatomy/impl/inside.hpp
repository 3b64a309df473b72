#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <skelgen/core/curve_graph.hpp>
#include <skelgen/core/curve_skeleton.hpp>
#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/surface/body.hpp>

namespace skelgen::anatomy {

/// A skeleton of which all joints lie inside the body.
template <typename Scalar = double>
struct MovedInside {
    KinematicSkeleton<Scalar> skeleton;
    std::vector<int> moved; ///< joints that were outside, ascending
};

namespace detail {

/// The place inside nearest to `start`, in steps of the way from there to `goal`; one step farther where that is
/// inside, too, not to lie on the surface itself.
template <typename Scalar>
Vector3<Scalar> first_place_inside(const Body<Scalar>& body, const Vector3<Scalar>& start,
                                   const Vector3<Scalar>& goal) {
    constexpr int steps = 20; // each a few millimetres where the surface is a limb's
    const Vector3<Scalar> way = goal - start;
    const auto place = [&](int step) -> Vector3<Scalar> {
        return start + static_cast<Scalar>(std::min(step, steps)) / Scalar(steps) * way;
    };
    int step = 1;
    while (step < steps && !surface::is_inside(body, place(step))) ++step;
    return surface::is_inside(body, place(step + 1)) ? place(step + 1) : place(step);
}

} // namespace detail

/// Moves joints that landed outside the surface (generalized winding number of a half or less, JKS13) to the nearest
/// place inside on the way to the curve skeleton, in twentieths of it, with a warning each. O(joints n).
template <typename Scalar>
MovedInside<Scalar> move_inside(KinematicSkeleton<Scalar> skeleton, const Body<Scalar>& body,
                                const CurveSkeleton<Scalar>& curve) {
    MovedInside<Scalar> out{std::move(skeleton), {}};
    std::vector<Joint<Scalar>>& joints = out.skeleton.joints;
    for (std::size_t j = 0; j < joints.size(); ++j)
        if (joints[j].is_present && !surface::is_inside(body, joints[j].position))
            out.moved.push_back(static_cast<int>(j));
    for (const int j : out.moved) {
        Joint<Scalar>& joint = joints[static_cast<std::size_t>(j)];
        const Vector3<Scalar> nearest = curve.nodes.row(core::nearest_node(curve, joint.position));
        joint.position = detail::first_place_inside(body, joint.position, nearest);
        const std::string warning = "joint " + joint.name + " was outside the surface and has been moved in";
        std::vector<std::string>& warnings = out.skeleton.quality.warnings;
        if (std::find(warnings.begin(), warnings.end(), warning) == warnings.end()) warnings.push_back(warning);
    }
    return out;
}

} // namespace skelgen::anatomy
