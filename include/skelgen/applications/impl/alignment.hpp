#pragma once

#include <skelgen/applications/alignment.hpp>

#include <algorithm>

#include <skelgen/applications/body_coordinates.hpp>
#include <skelgen/applications/canonical_frame.hpp>
#include <skelgen/core/error.hpp>
#include <skelgen/core/header_only.hpp>
#include <skelgen/core/options.hpp>

namespace skelgen::applications {

template <typename Scalar>
PelvisDirections<Scalar> pelvis_directions(const KinematicSkeleton<Scalar>& skeleton) {
    const Vector3<Scalar> left = joint_place(skeleton, "left_hip"), right = joint_place(skeleton, "right_hip");
    const Vector3<Scalar> middle = (left + right) / 2;
    Vector3<Scalar> up = Vector3<Scalar>::Zero();
    for (const char* joint : {"crotch", "waist", "chest"})
        up += (joint_place(skeleton, joint) - middle).stableNormalized();
    return {left - right, up};
}

SKELGEN_INLINE void validate(const AlignmentOptions& options) {
    core::require_in_range("alignment.scale", options.scale, 1e-12, 1e12);
}

template <typename Scalar>
Eigen::Matrix<Scalar, 4, 4> alignment(const KinematicSkeleton<Scalar>& skeleton, const Points<Scalar>& vertices,
                                      const AlignmentOptions& options) {
    validate(options);
    if (vertices.rows() == 0) throw Error(ErrorCode::usage, "a body without vertices cannot be aligned");
    const PelvisDirections<Scalar> pelvis = pelvis_directions(skeleton);
    const Eigen::Matrix<Scalar, 3, 3> turn =
        static_cast<Scalar>(options.scale) * rotation_to_canonical(pelvis.left, pelvis.up).toRotationMatrix();
    Vector3<Scalar> origin = turn * joint_place(skeleton, "crotch");
    if (options.origin == AlignedOrigin::floor)
        for (Eigen::Index v = 0; v < vertices.rows(); ++v)
            origin.y() = std::min(origin.y(), turn.row(1).dot(vertices.row(v)));
    Eigen::Matrix<Scalar, 4, 4> out = Eigen::Matrix<Scalar, 4, 4>::Identity();
    out.template topLeftCorner<3, 3>() = turn;
    out.template topRightCorner<3, 1>() = -origin;
    return out;
}

template <typename Scalar>
Points<Scalar> transformed(const Points<Scalar>& points, const Eigen::Matrix<Scalar, 4, 4>& transform) {
    const Eigen::Matrix<Scalar, 3, 3> linear = transform.template topLeftCorner<3, 3>();
    const Vector3<Scalar> shift = transform.template topRightCorner<3, 1>();
    return (points * linear.transpose()).rowwise() + shift.transpose();
}

} // namespace skelgen::applications
