#pragma once

// A limb whose bends are known in closed form.

#include <skelgen/core/geometry.hpp>
#include <skelgen/core/kinematic_skeleton.hpp>

#include "shapes.hpp"

namespace skelgen::test {

/// A tube around the left arm of the template, from the middle of the upper arm to that of the forearm.
inline TriangleMesh<double> sleeve(const KinematicSkeleton<double>& rest) {
    const auto at = [&](const char* name) {
        return rest.joints[static_cast<std::size_t>(find_joint(rest, name))].position;
    };
    const Eigen::Vector3d from = (at("left_shoulder") + at("left_elbow")) / 2,
                          to = (at("left_elbow") + at("left_wrist")) / 2;
    TriangleMesh<double> tube = capsule(0.04, (to - from).norm());
    const Eigen::Quaterniond turn = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), to - from);
    for (Eigen::Index v = 0; v < tube.vertices.rows(); ++v)
        tube.vertices.row(v) = (from + turn * tube.vertices.row(v).transpose()).transpose();
    return tube;
}

} // namespace skelgen::test
