#pragma once

#include <skelgen/applications/posing.hpp>

#include <cstddef>
#include <numbers>

#include <skelgen/core/error.hpp>

namespace skelgen::applications {

template <typename Scalar>
Orientations<Scalar> orientations_in(RestPose pose, const SkeletonTemplate& skeleton_template,
                                     const Orientations<Scalar>& now, const Eigen::Quaternion<Scalar>& to_canonical) {
    using Rotation = Eigen::Quaternion<Scalar>;
    constexpr Scalar lowered = std::numbers::pi_v<Scalar> / 4;
    Orientations<Scalar> out;
    for (std::size_t j = 0; j < skeleton_template.joints.size(); ++j) {
        const TemplateJoint& joint = skeleton_template.joints[j];
        const bool is_lowered = pose == RestPose::a_pose && part_of(joint.role) == BodyPart::arm;
        const Scalar angle = joint.side == Side::left ? -lowered : lowered;
        if (pose == RestPose::as_is)
            out.push_back((to_canonical * now[j]).normalized());
        else if (is_lowered)
            out.push_back(Rotation(Eigen::AngleAxis<Scalar>(angle, Vector3<Scalar>::UnitZ())));
        else
            out.push_back(Rotation::Identity());
    }
    return out;
}

template <typename Scalar>
std::vector<RigidMotion<Scalar>> motions(const KinematicSkeleton<Scalar>& skeleton, const Orientations<Scalar>& from,
                                         const Orientations<Scalar>& to, const Vector3<Scalar>& root) {
    if (from.size() != skeleton.joints.size() || to.size() != skeleton.joints.size())
        throw Error(ErrorCode::usage, "a pose must have as many orientations as the skeleton has joints");
    std::vector<RigidMotion<Scalar>> out;
    for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
        const Joint<Scalar>& joint = skeleton.joints[j];
        const Vector3<Scalar> place =
            joint.parent < 0 ? root : out[static_cast<std::size_t>(joint.parent)](joint.position);
        RigidMotion<Scalar> motion;
        motion.rotation = (to[j] * from[j].conjugate()).normalized();
        motion.translation = place - motion.rotation * joint.position;
        out.push_back(motion);
    }
    return out;
}

template <typename Scalar>
KinematicSkeleton<Scalar> moved(const KinematicSkeleton<Scalar>& skeleton, const SkeletonTemplate& skeleton_template,
                                const std::vector<RigidMotion<Scalar>>& motions) {
    KinematicSkeleton<Scalar> out = skeleton;
    for (std::size_t j = 0; j < out.joints.size(); ++j) {
        out.joints[j].position = motions[j](skeleton.joints[j].position);
        const TemplateJoint& joint = skeleton_template.joints[j];
        for (auto& [name, place] : out.end_points)
            if (ends_limb(joint.role) && name == end_point_name(joint)) place = motions[j](place);
    }
    const RigidMotion<Scalar>& root = motions.front();
    out.frame = {root(skeleton.frame.origin), root.rotation * skeleton.frame.left,
                 root.rotation * skeleton.frame.forward, root.rotation * skeleton.frame.up};
    return out;
}

} // namespace skelgen::applications
