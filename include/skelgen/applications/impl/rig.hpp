#pragma once

#include <skelgen/applications/rig.hpp>

#include <cstddef>
#include <utility>

#include <skelgen/applications/bind.hpp>
#include <skelgen/applications/bone_orientations.hpp>
#include <skelgen/applications/bones.hpp>
#include <skelgen/applications/floor.hpp>
#include <skelgen/applications/lowest_place.hpp>
#include <skelgen/applications/outward_faces.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/header_only.hpp>

namespace skelgen::applications {
namespace detail {

/// In metres where the unit is known, on the floor, with the root above the origin.
template <typename Scalar>
Rig<Scalar> put_in_place(Rig<Scalar> rig, Scalar height) {
    const auto metres = static_cast<Scalar>(metres_per_unit(static_cast<double>(height)));
    rig.unit_is_known = metres > 0;
    if (rig.unit_is_known) rig.metres_per_unit = metres;
    const Scalar floor = lowest_place<Scalar>(rig.mesh, Vector3<Scalar>::UnitY(), places_of(rig.joints));
    const Vector3<Scalar> root = rig.joints.front().position, origin(root[0], floor, root[2]);
    for (Eigen::Index v = 0; v < rig.mesh.vertices.rows(); ++v) {
        const Vector3<Scalar> placed = rig.metres_per_unit * (core::point(rig.mesh.vertices, v) - origin);
        core::set_point<Scalar>(rig.mesh.vertices, v, placed);
    }
    for (RigJoint<Scalar>& joint : rig.joints) {
        joint.position = rig.metres_per_unit * (joint.position - origin);
        joint.end = rig.metres_per_unit * (joint.end - origin);
    }
    return rig;
}

} // namespace detail

template <typename Scalar>
Scalar height_by_bones(const KinematicSkeleton<Scalar>& skeleton, const SkeletonTemplate& skeleton_template) {
    const auto up_from = [&](int joint) {
        Scalar length = 0;
        for (int j = joint; j >= 0; j = next_joint(skeleton_template, j)) {
            const JointRole role = skeleton_template.joint(j).role;
            if (role == JointRole::ankle || role == JointRole::foot) break; // what is below is as long as it is high
            length += (bone_end(skeleton, skeleton_template, j) - skeleton.joints[static_cast<std::size_t>(j)].position)
                          .norm();
        }
        return length;
    };
    const int left = find_joint(skeleton_template, JointRole::hip, Side::left);
    const int right = find_joint(skeleton_template, JointRole::hip, Side::right);
    return up_from(0) + (up_from(left) + up_from(right)) / 2;
}

SKELGEN_INLINE double metres_per_unit(double height) {
    constexpr double least = 0.5, most = 2.5; // a child of a year is 0.7 m; ankles are 0.1 m above the floor
    for (const double metres : {1.0, 0.01, 0.001})
        if (height * metres >= least && height * metres <= most) return metres;
    return 0;
}

template <typename Scalar>
Rig<Scalar> make_rig(const TriangleMesh<Scalar>& mesh, const Body<Scalar>& body,
                     const KinematicSkeleton<Scalar>& skeleton, const SkeletonTemplate& skeleton_template,
                     RestPose rest) {
    Rig<Scalar> rig;
    rig.rest = rest;
    rig.skin = bind(mesh, body, skeleton, skeleton_template);

    const Orientations<Scalar> now = bone_orientations(skeleton, skeleton_template);
    const auto to_canonical = rotation_to_canonical(skeleton.frame.left, upright(mesh, skeleton, skeleton_template));
    const auto motion = rest_motions(rest, skeleton, skeleton_template, now, to_canonical);
    rig.mesh = {skinned(mesh.vertices, rig.skin, motion), outward_faces(mesh, body)};
    rig.turns = skin_turns(rig.skin, motion);

    const Orientations<Scalar> axes = bone_axes(skeleton, skeleton_template, now);
    for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
        const TemplateJoint& joint = skeleton_template.joints[j];
        const Vector3<Scalar> end = bone_end(skeleton, skeleton_template, static_cast<int>(j));
        rig.joints.push_back({joint.name, joint.parent, joint.role, joint.side, motion[j](skeleton.joints[j].position),
                              motion[j](end), (motion[j].rotation * axes[j]).normalized(),
                              skeleton.joints[j].confidence, (motion[j].rotation * now[j]).normalized()});
    }
    return detail::put_in_place(std::move(rig), height_by_bones(skeleton, skeleton_template));
}

} // namespace skelgen::applications
