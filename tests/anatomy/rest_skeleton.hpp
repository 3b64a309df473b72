#pragma once

// human21 in its rest pose as a skeleton, and shapes to put joints into.

#include <string>
#include <vector>

#include <skelgen/core/builtin_templates.hpp>
#include <skelgen/core/curve_skeleton.hpp>
#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/surface/body.hpp>

#include "shapes.hpp"

namespace skelgen::test {

/// In space as in the template: x to the left, y up, z forward.
template <typename Scalar = double>
KinematicSkeleton<Scalar> rest_skeleton() {
    KinematicSkeleton<Scalar> out;
    for (const TemplateJoint& joint : builtin_template("human21").joints)
        out.joints.push_back({joint.name, joint.parent, joint.position.template cast<Scalar>(), Scalar(0)});
    return out;
}

template <typename Scalar>
const Joint<Scalar>& joint_named(const KinematicSkeleton<Scalar>& skeleton, const std::string& name) {
    return skeleton.joints.at(static_cast<std::size_t>(find_joint(skeleton, name)));
}

template <typename Scalar>
const Vector3<Scalar>& at(const KinematicSkeleton<Scalar>& skeleton, const std::string& name) {
    return joint_named(skeleton, name).position;
}

template <typename Scalar>
Vector3<Scalar>& at(KinematicSkeleton<Scalar>& skeleton, const std::string& name) {
    return skeleton.joints.at(static_cast<std::size_t>(find_joint(skeleton, name))).position;
}

template <typename Scalar>
Scalar length(const KinematicSkeleton<Scalar>& skeleton, const std::string& a, const std::string& b) {
    return (at(skeleton, a) - at(skeleton, b)).norm();
}

/// `count` joints in one place, the first of them the root.
template <typename Scalar = double>
KinematicSkeleton<Scalar> joints_at(std::size_t count, const Vector3<Scalar>& place) {
    KinematicSkeleton<Scalar> out;
    for (std::size_t j = 0; j < count; ++j)
        out.joints.push_back({"joint " + std::to_string(j), static_cast<int>(j) - 1, place, Scalar(0)});
    return out;
}

/// As a body in the coordinates that it is in.
template <typename Scalar = double>
Body<Scalar> body_of(const Mesh& mesh) {
    std::vector<int> source;
    for (int v = 0; v < mesh.vertices.rows(); ++v) source.push_back(v);
    return surface::make_body<Scalar>({mesh.vertices.cast<Scalar>(), mesh.faces}, {}, source, 0);
}

/// A curve along the axis of a capsule from z = 0 to 4.
template <typename Scalar = double>
CurveSkeleton<Scalar> axis_curve() {
    CurveSkeleton<Scalar> curve;
    curve.nodes.resize(3, 3);
    curve.nodes << 0, 0, 0, 0, 0, 2, 0, 0, 4;
    return curve;
}

} // namespace skelgen::test
