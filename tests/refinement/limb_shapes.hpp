#pragma once

// Limbs and bodies whose joints are known, made by code.

#include <utility>
#include <vector>

#include <skelgen/core/builtin_templates.hpp>
#include <skelgen/core/curve_graph.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/polyline.hpp>
#include <skelgen/refinement/end_points.hpp>
#include <skelgen/refinement/limbs.hpp>
#include <skelgen/surface/body.hpp>

#include "shapes.hpp"

namespace skelgen::test {

template <typename Scalar>
TriangleMesh<Scalar> mesh_in(const Mesh& mesh) {
    return {mesh.vertices.cast<Scalar>(), mesh.faces};
}

/// The mesh as it is, as a body.
template <typename Scalar>
Body<Scalar> body_of(const Mesh& mesh) {
    return surface::make_body(mesh_in<Scalar>(mesh), Similarity<Scalar>{}, {}, 0);
}

/// A limb's end at the vertex nearest to `place`.
template <typename Scalar>
refinement::EndPoint<Scalar> end_point_near(const Body<Scalar>& body, const Vec3& place, int joint = -1) {
    const int vertex = core::nearest_vertex(body.mesh, Vector3<Scalar>(place.cast<Scalar>()));
    const std::vector<Scalar> distance = core::shortest_paths(body.graph, vertex).distance;
    return {joint, vertex,
            Eigen::Map<const Eigen::VectorX<Scalar>>(distance.data(), static_cast<Eigen::Index>(distance.size()))};
}

/// A limb along a polyline from the trunk to the tip, with round sections of one thickness every `step`, all its own.
template <typename Scalar = double>
refinement::Limb<Scalar> limb_along(const std::vector<Vec3>& corners, std::vector<int> joints,
                                    const std::vector<double>& from_tip, double thickness = 0.05, double step = 0.01) {
    Points<double> line(static_cast<Eigen::Index>(corners.size()), 3);
    for (std::size_t i = 0; i < corners.size(); ++i) line.row(static_cast<Eigen::Index>(i)) = corners[i].transpose();
    refinement::Limb<Scalar> limb;
    limb.joints = std::move(joints);
    limb.from_tip.assign(from_tip.begin(), from_tip.end());
    const Points<double> points = core::resample(line, step);
    limb.line.points = points.cast<Scalar>();
    limb.line.arc = core::arc_lengths(points).cast<Scalar>();
    limb.line.thickness = Eigen::VectorX<Scalar>::Constant(points.rows(), static_cast<Scalar>(thickness));
    limb.line.area = Eigen::VectorX<Scalar>::Constant(points.rows(), static_cast<Scalar>(pi * thickness * thickness));
    limb.line.flatness = Eigen::VectorX<Scalar>::Zero(points.rows());
    return limb;
}

/// The same template in another unit.
inline SkeletonTemplate scaled(SkeletonTemplate skeleton_template, double factor) {
    for (TemplateJoint& joint : skeleton_template.joints) {
        joint.position *= factor;
        joint.radius *= factor;
        if (joint.tip) *joint.tip *= factor;
    }
    return skeleton_template;
}

inline int joint_of(JointRole role, Side side = Side::none) {
    return find_joint(builtin_template("human21"), role, side);
}

} // namespace skelgen::test
