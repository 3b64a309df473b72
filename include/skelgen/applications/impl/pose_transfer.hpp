#pragma once

#include <skelgen/applications/pose_transfer.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <skelgen/applications/bone_orientations.hpp>
#include <skelgen/applications/floor.hpp>
#include <skelgen/applications/impl/bind.hpp>
#include <skelgen/applications/impl/bones.hpp>
#include <skelgen/applications/impl/outward_faces.hpp>
#include <skelgen/applications/impl/rest_posture.hpp>
#include <skelgen/applications/lowest_place.hpp>
#include <skelgen/applications/posing.hpp>
#include <skelgen/applications/rig.hpp>
#include <skelgen/applications/skinning.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/precision.hpp>

namespace skelgen::applications {
namespace detail {

/// Geometric median of the ways from the joints of one skeleton to those of another, of those that both have, by
/// Weiszfeld's rounds from their mean on: joints that were found off move it far less than they do the mean.
template <typename Scalar>
Vector3<Scalar> median_way(const KinematicSkeleton<Scalar>& from, const KinematicSkeleton<Scalar>& to) {
    constexpr int rounds = 50;
    constexpr Scalar nearest = Scalar(1e-3); // of the mean distance: what lies nearer has no more say
    std::vector<Vector3<Scalar>> ways;
    for (std::size_t j = 0; j < from.joints.size(); ++j)
        if (from.joints[j].is_present && to.joints[j].is_present)
            ways.push_back(to.joints[j].position - from.joints[j].position);
    Vector3<Scalar> median = Vector3<Scalar>::Zero();
    if (ways.empty()) return median;
    for (const Vector3<Scalar>& way : ways) median += way / static_cast<Scalar>(ways.size());
    Scalar spread = 0;
    for (const Vector3<Scalar>& way : ways) spread += (way - median).norm() / static_cast<Scalar>(ways.size());
    if (!(spread > core::rounding<Scalar>() * median.norm())) return median;
    for (int round = 0; round < rounds; ++round) {
        Vector3<Scalar> sum = Vector3<Scalar>::Zero();
        Scalar weights = 0;
        for (const Vector3<Scalar>& way : ways) {
            const Scalar weight = 1 / std::max(nearest * spread, (way - median).norm());
            sum += weight * way;
            weights += weight;
        }
        median = sum / weights;
    }
    return median;
}

/// The axis of the coordinates that is up where it is within 20 degrees of this direction: trunks lean. Else itself.
template <typename Scalar>
Vector3<Scalar> up_by_axes(const Vector3<Scalar>& up) {
    Eigen::Index axis = 0;
    const Scalar along = up.normalized().cwiseAbs().maxCoeff(&axis);
    return along >= std::cos(Scalar(near_axes)) ? Vector3<Scalar>(Vector3<Scalar>::Unit(axis) * (up[axis] < 0 ? -1 : 1))
                                                : up;
}

} // namespace detail

template <typename Scalar>
PosedBody<Scalar> pose_like(const TriangleMesh<Scalar>& mesh, const Body<Scalar>& body,
                            const KinematicSkeleton<Scalar>& skeleton, const KinematicSkeleton<Scalar>& model,
                            const SkeletonTemplate& skeleton_template) {
    const auto held = [&](const KinematicSkeleton<Scalar>& one, const Vector3<Scalar>& up) {
        return posture(one, skeleton_template, rotation_to_canonical(one.frame.left, up));
    };
    const Orientations<Scalar> from = held(skeleton, upright(mesh, skeleton, skeleton_template));
    const Orientations<Scalar> to = held(model, detail::up_by_axes<Scalar>(model.frame.up));
    const Skin<Scalar> skin = bind(mesh, body, skeleton, skeleton_template);
    auto motion = motions<Scalar>(skeleton, from, to, model.joints.front().position,
                                  girdle_lines(skeleton, from, model, to, skeleton_template));
    const Vector3<Scalar> way = detail::median_way(moved(skeleton, skeleton_template, motion), model);
    for (RigidMotion<Scalar>& of_joint : motion) of_joint.translation += way;
    return {{skinned(mesh.vertices, skin, motion), outward_faces(mesh, body)},
            moved(skeleton, skeleton_template, motion),
            skin_turns(skin, motion)};
}

template <typename Scalar>
PosedBody<Scalar> put_on(PosedBody<Scalar> body, const Floor<Scalar>& floor) {
    const Vector3<Scalar> shift =
        (floor.height - lowest_place<Scalar>(body.mesh, floor.up, places_of(body.skeleton))) * floor.up;
    body.mesh.vertices.rowwise() += shift.transpose();
    for (Joint<Scalar>& joint : body.skeleton.joints) joint.position += shift;
    for (auto& [name, place] : body.skeleton.end_points) place += shift;
    body.skeleton.frame.origin += shift;
    return body;
}

} // namespace skelgen::applications
