#pragma once

#include <skelgen/applications/rig.hpp>

#include <cstddef>
#include <utility>

#include <skelgen/applications/bone_orientations.hpp>
#include <skelgen/applications/floor.hpp>
#include <skelgen/applications/impl/bind.hpp>
#include <skelgen/applications/impl/bones.hpp>
#include <skelgen/applications/impl/outward_faces.hpp>
#include <skelgen/applications/impl/rest_posture.hpp>
#include <skelgen/applications/lowest_place.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/header_only.hpp>

namespace skelgen::applications {
namespace detail {

/// Where an input was before it was put into a rest pose, turned as that is.
template <typename Scalar>
struct FormerPlace {
    TriangleMesh<Scalar> mesh;
    Points<Scalar> skeleton; ///< the root first
    bool is_turned;          ///< by other than the axes of its coordinates
};

/// In metres where the unit is known, at the given place.
template <typename Scalar>
Rig<Scalar> put_in_place(Rig<Scalar> rig, Scalar height, const RigOptions& options, const FormerPlace<Scalar>& was) {
    const double known = options.metres_per_unit;
    const auto metres = static_cast<Scalar>(known > 0 ? known : metres_per_unit(static_cast<double>(height)));
    rig.unit_is_known = metres > 0;
    if (rig.unit_is_known) rig.metres_per_unit = metres;
    const Vector3<Scalar> up = Vector3<Scalar>::UnitY();
    const Scalar floor = lowest_place<Scalar>(rig.mesh, up, places_of(rig.joints));
    const Vector3<Scalar> root = rig.joints.front().position;
    Vector3<Scalar> origin(root[0], floor, root[2]); // what comes to lie at the origin
    if (options.place != Place::centre && !was.is_turned) {
        origin -= Vector3<Scalar>(was.skeleton(0, 0), 0, was.skeleton(0, 2));
        if (options.place == Place::keep) origin[1] -= lowest_place<Scalar>(was.mesh, up, was.skeleton);
    }
    for (Eigen::Index v = 0; v < rig.mesh.vertices.rows(); ++v) {
        const Vector3<Scalar> placed = rig.metres_per_unit * (core::point(rig.mesh.vertices, v) - origin);
        core::set_point<Scalar>(rig.mesh.vertices, v, placed);
    }
    for (RigidMotion<Scalar>& motion : rig.motions)
        motion.translation = rig.metres_per_unit * (motion.translation - origin);
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
                     const RigOptions& options) {
    Rig<Scalar> rig;
    rig.rest = options.rest;
    const auto seen = rotation_to_canonical(skeleton.frame.left, upright(mesh, skeleton, skeleton_template));
    const auto axes_to_axes = along_axes(seen);
    const Eigen::Quaternion<Scalar> by_axes = axes_to_axes.value_or(seen);
    // A scene that is turned by its axes, or not at all, still looks a little aside: so does the rest pose then.
    const Eigen::Quaternion<Scalar> aside = about_vertical<Scalar>(by_axes * seen.conjugate());
    const Eigen::Quaternion<Scalar> to_canonical = aside.conjugate() * by_axes;
    const Orientations<Scalar> now = posture(skeleton, skeleton_template, to_canonical);
    auto motion = posture_motions(options.rest, skeleton, skeleton_template, now, to_canonical);
    const Orientations<Scalar> axes = bone_axes(skeleton, skeleton_template, now);
    StartOfBends<Scalar> start; // not as it is: what lies squeezed in a crease says nothing of how far it may stretch
    if (options.rest != RestPose::as_is) {
        start.motions = motion;
        for (std::size_t j = 0; j < axes.size(); ++j) start.axes.push_back((motion[j].rotation * axes[j]).normalized());
    }
    rig.skin = bind(mesh, body, skeleton, skeleton_template, std::move(start));
    for (RigidMotion<Scalar>& of_joint : motion)
        of_joint = {(aside * of_joint.rotation).normalized(), aside * of_joint.translation};
    rig.mesh = {skinned(mesh.vertices, rig.skin, motion), outward_faces(mesh, body)};
    rig.turns = skin_turns(rig.skin, motion);
    rig.motions = motion;

    for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
        const TemplateJoint& joint = skeleton_template.joints[j];
        const Vector3<Scalar> end = bone_end(skeleton, skeleton_template, static_cast<int>(j));
        rig.joints.push_back({joint.name, joint.parent, joint.role, joint.side, motion[j](skeleton.joints[j].position),
                              motion[j](end), (motion[j].rotation * axes[j]).normalized(),
                              skeleton.joints[j].confidence, (motion[j].rotation * now[j]).normalized()});
    }
    const Eigen::Matrix3<Scalar> turned = by_axes.toRotationMatrix().transpose(); // as points are rows
    return detail::put_in_place<Scalar>(
        std::move(rig), height_by_bones(skeleton, skeleton_template), options,
        {{mesh.vertices * turned, mesh.faces}, places_of(skeleton) * turned, !axes_to_axes});
}

} // namespace skelgen::applications
