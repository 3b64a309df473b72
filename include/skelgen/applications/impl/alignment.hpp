#pragma once

#include <skelgen/applications/alignment.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include <skelgen/applications/body_coordinates.hpp>
#include <skelgen/applications/canonical_frame.hpp>
#include <skelgen/applications/impl/mirror_plane.hpp>
#include <skelgen/core/error.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/header_only.hpp>
#include <skelgen/core/options.hpp>

namespace skelgen::applications {

namespace detail {

/// The back of the pelvis, of the body as its directions show it: from just below the crotch to the loins, as broad as
/// the hips, and what hangs together there; sizes relative to the trunk, from crotch to neck.
template <typename Scalar>
SurfaceSamples<Scalar> pelvis_back(const Body<Scalar>& body, const KinematicSkeleton<Scalar>& inside,
                                   const PelvisDirections<Scalar>& pelvis, const Points<Scalar>& normals,
                                   const Eigen::VectorX<core::Accumulator>& areas) {
    constexpr Scalar below = Scalar(0.08), above = Scalar(0.4), aside = Scalar(0.38), around = Scalar(0.55);
    const Vector3<Scalar> crotch = joint_place(inside, "crotch");
    const Scalar trunk = (joint_place(inside, "neck") - crotch).norm();
    const Eigen::Quaternion<Scalar> turn = rotation_to_canonical(pelvis.left, pelvis.up);
    const auto is_there = [&](int v) {
        const Vector3<Scalar> place = core::point(body.mesh.vertices, v) - crotch, p = turn * place / trunk;
        return p.norm() < around && p.y() > -below && p.y() < above && std::abs(p.x()) < aside && p.z() < 0;
    };
    const Vector3<Scalar> back = turn.conjugate() * -Vector3<Scalar>::UnitZ();
    const Vector3<Scalar> middle = crotch + above / 2 * trunk * pelvis.up.normalized();
    const auto hit = body.tree.first_along(body.mesh, middle, back);
    std::vector<int> members;
    std::vector<bool> seen(static_cast<std::size_t>(body.mesh.vertices.rows()), false);
    const auto add = [&](int v) {
        if (seen[static_cast<std::size_t>(v)] || !is_there(v)) return;
        seen[static_cast<std::size_t>(v)] = true;
        members.push_back(v);
    };
    if (hit.face >= 0)
        for (int k = 0; k < 3; ++k) add(body.mesh.faces(hit.face, k));
    for (std::size_t i = 0; i < members.size(); ++i)
        for (const auto& [next, length] : body.graph.neighbours[static_cast<std::size_t>(members[i])]) add(next);
    std::sort(members.begin(), members.end());
    SurfaceSamples<Scalar> out;
    const auto count = static_cast<Eigen::Index>(members.size());
    out.places.resize(count, 3), out.normals.resize(count, 3), out.areas.resize(count);
    for (Eigen::Index i = 0; i < count; ++i) {
        const int v = members[static_cast<std::size_t>(i)];
        out.places.row(i) = body.mesh.vertices.row(v), out.normals.row(i) = normals.row(v), out.areas[i] = areas[v];
    }
    return out;
}

/// The transform by these directions.
template <typename Scalar>
Eigen::Matrix<Scalar, 4, 4> alignment_by(const PelvisDirections<Scalar>& pelvis, const Vector3<Scalar>& crotch,
                                         const Points<Scalar>& vertices, const AlignmentOptions& options) {
    if (vertices.rows() == 0) throw Error(ErrorCode::usage, "a body without vertices cannot be aligned");
    const Eigen::Matrix<Scalar, 3, 3> turn =
        static_cast<Scalar>(options.scale) * rotation_to_canonical(pelvis.left, pelvis.up).toRotationMatrix();
    Vector3<Scalar> origin = turn * crotch;
    if (options.origin == AlignedOrigin::floor)
        for (Eigen::Index v = 0; v < vertices.rows(); ++v)
            origin.y() = std::min(origin.y(), turn.row(1).dot(vertices.row(v)));
    Eigen::Matrix<Scalar, 4, 4> out = Eigen::Matrix<Scalar, 4, 4>::Identity();
    out.template topLeftCorner<3, 3>() = turn;
    out.template topRightCorner<3, 1>() = -origin;
    return out;
}

} // namespace detail

template <typename Scalar>
PelvisDirections<Scalar> pelvis_directions(const KinematicSkeleton<Scalar>& skeleton) {
    const Vector3<Scalar> left = joint_place(skeleton, JointRole::hip, Side::left),
                          right = joint_place(skeleton, JointRole::hip, Side::right);
    const Vector3<Scalar> middle = (left + right) / 2;
    if (own_template(skeleton).plan == BodyKind::quadruped) {
        const Vector3<Scalar> across = left - right + joint_place(skeleton, JointRole::shoulder, Side::left) -
                                       joint_place(skeleton, JointRole::shoulder, Side::right);
        return {across, (joint_place(skeleton, JointRole::chest) - middle).cross(across)};
    }
    Vector3<Scalar> up = Vector3<Scalar>::Zero();
    for (const auto& [role, weight] : {std::pair(JointRole::pelvis, Scalar(1)), std::pair(JointRole::waist, Scalar(2)),
                                       std::pair(JointRole::chest, Scalar(0.5))})
        up += weight * (joint_place(skeleton, role) - middle).stableNormalized();
    return {left - right, up};
}

template <typename Scalar>
PelvisDirections<Scalar> pelvis_directions(const Body<Scalar>& body, const KinematicSkeleton<Scalar>& skeleton) {
    if (own_template(skeleton).plan == BodyKind::quadruped) return pelvis_directions(skeleton);
    constexpr int rounds = 2; // the pelvis's back is where the directions say
    const Scalar largest_turn = std::cos(Scalar(35 * std::numbers::pi / 180));
    const KinematicSkeleton<Scalar> inside = surface::to_body(body, skeleton);
    const PelvisDirections<Scalar> hips = pelvis_directions(inside);
    const Scalar look = (joint_place(inside, "neck") - joint_place(inside, "crotch")).norm() / 5;
    const Points<Scalar> normals = core::vertex_normals(body.mesh);
    const Eigen::VectorX<core::Accumulator> areas = core::vertex_areas(body.mesh);
    const auto at_right_angles = [&](const Vector3<Scalar>& left) -> PelvisDirections<Scalar> {
        return {left, hips.up - hips.up.dot(left) * left};
    };
    const Vector3<Scalar> line = hips.left.stableNormalized();
    const Vector3<Scalar> middle = (joint_place(inside, "left_hip") + joint_place(inside, "right_hip")) / 2;
    PelvisDirections<Scalar> pelvis = at_right_angles(line);
    for (int round = 0; round < rounds; ++round) {
        const SurfaceSamples<Scalar> back = detail::pelvis_back(body, inside, pelvis, normals, areas);
        const MirrorPlane<Scalar> guess{pelvis.left, pelvis.left.dot(middle)};
        pelvis = at_right_angles(mirror_plane(back, guess, look).normal);
        if (pelvis.left.dot(line) < largest_turn) {
            pelvis = at_right_angles(line);
            break;
        }
    }
    return {body.similarity.direction_to_input(pelvis.left), body.similarity.direction_to_input(pelvis.up)};
}

SKELGEN_INLINE void validate(const AlignmentOptions& options) {
    core::require_in_range("alignment.scale", options.scale, 1e-12, 1e12);
}

template <typename Scalar>
Eigen::Matrix<Scalar, 4, 4> alignment(const KinematicSkeleton<Scalar>& skeleton, const Points<Scalar>& vertices,
                                      const AlignmentOptions& options) {
    validate(options);
    return detail::alignment_by(pelvis_directions(skeleton), joint_place(skeleton, JointRole::pelvis), vertices,
                                options);
}

template <typename Scalar>
Eigen::Matrix<Scalar, 4, 4> alignment(const Body<Scalar>& body, const KinematicSkeleton<Scalar>& skeleton,
                                      const Points<Scalar>& vertices, const AlignmentOptions& options) {
    validate(options);
    return detail::alignment_by(pelvis_directions(body, skeleton), joint_place(skeleton, JointRole::pelvis), vertices,
                                options);
}

template <typename Scalar>
Points<Scalar> transformed(const Points<Scalar>& points, const Eigen::Matrix<Scalar, 4, 4>& transform) {
    const Eigen::Matrix<Scalar, 3, 3> linear = transform.template topLeftCorner<3, 3>();
    const Vector3<Scalar> shift = transform.template topRightCorner<3, 1>();
    return (points * linear.transpose()).rowwise() + shift.transpose();
}

} // namespace skelgen::applications
