#pragma once

#include <skelgen/applications/floor.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>

#include <skelgen/applications/impl/bones.hpp>
#include <skelgen/applications/lowest_place.hpp>
#include <skelgen/applications/rig.hpp>
#include <skelgen/core/geometry.hpp>

namespace skelgen::applications {
namespace detail {

/// How far above the floor toes and heel of a foot may be whose sole lies flat on it, and how far beside the ankle the
/// heel is looked for, in the body's height. A foot is a seventh of that long: 12 degrees lift one of the two as far.
inline constexpr double lifted = 0.03, around_ankle = 0.05;

/// How far a trunk leans, as a cosine, that is believed to stand on one sole alone: a floor seen by one foot may be any
/// plane that its edge lies on. 25 degrees.
inline constexpr double leans_on_one_leg = 0.906;

/// How far above the floor the lowest place of a surface is within `reach` of the vertical line through `at`.
template <typename Scalar>
Scalar height_below(const TriangleMesh<Scalar>& mesh, const Floor<Scalar>& floor, const Vector3<Scalar>& at,
                    Scalar reach) {
    Scalar lowest = std::numeric_limits<Scalar>::infinity();
    for (Eigen::Index i = 0; i < mesh.faces.size(); ++i) {
        const Vector3<Scalar> corner = core::point(mesh.vertices, mesh.faces.data()[i]);
        const Scalar height = floor.up.dot(corner);
        if (height < lowest && (corner - at).cross(floor.up).norm() < reach) lowest = height;
    }
    return lowest - floor.height;
}

/// How many of the feet lie flat on the floor.
template <typename Scalar>
int flat_soles(const TriangleMesh<Scalar>& mesh, const KinematicSkeleton<Scalar>& skeleton,
               const SkeletonTemplate& skeleton_template, const Floor<Scalar>& floor) {
    const Scalar height = height_by_bones(skeleton, skeleton_template);
    const Scalar least = Scalar(lifted) * height, reach = Scalar(around_ankle) * height;
    int count = 0;
    for (const Side side : {Side::left, Side::right}) {
        const int foot = find_joint(skeleton_template, JointRole::foot, side);
        const int ankle = find_joint(skeleton_template, JointRole::ankle, side);
        if (foot < 0 || ankle < 0 || !skeleton.joints[static_cast<std::size_t>(foot)].is_present) continue;
        const Vector3<Scalar>& heel = skeleton.joints[static_cast<std::size_t>(ankle)].position;
        count += floor.up.dot(bone_end(skeleton, skeleton_template, foot)) - floor.height < least &&
                 height_below(mesh, floor, heel, reach) < least;
    }
    return count;
}

} // namespace detail

template <typename Scalar>
Floor<Scalar> floor_of(const TriangleMesh<Scalar>& mesh, const KinematicSkeleton<Scalar>& skeleton,
                       const SkeletonTemplate& skeleton_template) {
    Floor<Scalar> floor;
    Eigen::Index axis = 0;
    skeleton.frame.up.cwiseAbs().maxCoeff(&axis);
    floor.up = Vector3<Scalar>::Unit(axis) * (skeleton.frame.up[axis] < 0 ? Scalar(-1) : Scalar(1));
    floor.height = lowest_place<Scalar>(mesh, floor.up, places_of(skeleton));
    const Scalar near = height_by_bones(skeleton, skeleton_template) / 10;
    for (const Side side : {Side::left, Side::right}) {
        const int foot = find_joint(skeleton_template, JointRole::foot, side);
        const Joint<Scalar>& joint = skeleton.joints[static_cast<std::size_t>(foot)];
        const auto is_down = [&](const Vector3<Scalar>& place) { return floor.up.dot(place) - floor.height <= near; };
        if (joint.is_present && is_down(joint.position) && is_down(bone_end(skeleton, skeleton_template, foot)))
            floor.is_stood_on = true;
    }
    return floor;
}

template <typename Scalar>
Vector3<Scalar> upright(const TriangleMesh<Scalar>& mesh, const KinematicSkeleton<Scalar>& skeleton,
                        const SkeletonTemplate& skeleton_template) {
    const Floor<Scalar> floor = floor_of(mesh, skeleton, skeleton_template);
    const int flat = detail::flat_soles(mesh, skeleton, skeleton_template, floor);
    const bool stands = flat == 2 || (flat == 1 && floor.up.dot(skeleton.frame.up) > Scalar(detail::leans_on_one_leg));
    return stands ? floor.up : skeleton.frame.up;
}

} // namespace skelgen::applications
