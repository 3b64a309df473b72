#pragma once

#include <skelgen/applications/posing.hpp>

#include <cstddef>
#include <numbers>

#include <skelgen/applications/bones.hpp>
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
Orientations<Scalar> girdle_turns(const KinematicSkeleton<Scalar>& skeleton, const Orientations<Scalar>& from,
                                  const KinematicSkeleton<Scalar>& model, const Orientations<Scalar>& to,
                                  const SkeletonTemplate& skeleton_template) {
    using Rotation = Eigen::Quaternion<Scalar>;
    const std::size_t count = skeleton_template.joints.size();
    for (const std::size_t size : {skeleton.joints.size(), model.joints.size(), from.size(), to.size()})
        if (size != count) throw Error(ErrorCode::usage, "a skeleton's joints must be the template's");
    Orientations<Scalar> out(count, Rotation::Identity());
    for (std::size_t j = 0; j < count; ++j) {
        const TemplateJoint& joint = skeleton_template.joints[j];
        const auto parent = static_cast<std::size_t>(joint.parent);
        if (joint.role != JointRole::shoulder || !skeleton.joints[j].is_present || !model.joints[j].is_present)
            continue;
        const auto line = [&](const KinematicSkeleton<Scalar>& of) -> Vector3<Scalar> {
            return of.joints[j].position - of.joints[parent].position;
        };
        const Vector3<Scalar> is = line(skeleton), wanted = from[parent] * (to[parent].conjugate() * line(model));
        if (!is.isZero(0) && !wanted.isZero(0)) out[j] = Rotation::FromTwoVectors(is, wanted);
    }
    return out;
}

template <typename Scalar>
std::vector<RigidMotion<Scalar>> motions(const KinematicSkeleton<Scalar>& skeleton, const Orientations<Scalar>& from,
                                         const Orientations<Scalar>& to, const Vector3<Scalar>& root,
                                         const Orientations<Scalar>& girdle) {
    const std::size_t count = skeleton.joints.size();
    if (from.size() != count || to.size() != count || (!girdle.empty() && girdle.size() != count))
        throw Error(ErrorCode::usage, "a pose must have as many orientations as the skeleton has joints");
    std::vector<RigidMotion<Scalar>> out;
    for (std::size_t j = 0; j < count; ++j) {
        const Joint<Scalar>& joint = skeleton.joints[j];
        Vector3<Scalar> place = root;
        if (joint.parent >= 0) {
            const auto parent = static_cast<std::size_t>(joint.parent);
            const Vector3<Scalar> origin = skeleton.joints[parent].position, line = joint.position - origin;
            place = out[parent](girdle.empty() ? joint.position : Vector3<Scalar>(origin + girdle[j] * line));
        }
        RigidMotion<Scalar> motion;
        motion.rotation = (to[j] * from[j].conjugate()).normalized();
        motion.translation = place - motion.rotation * joint.position;
        out.push_back(motion);
    }
    return out;
}

template <typename Scalar>
std::vector<RigidMotion<Scalar>> rest_motions(RestPose pose, const KinematicSkeleton<Scalar>& skeleton,
                                              const SkeletonTemplate& skeleton_template,
                                              const Eigen::Quaternion<Scalar>& to_canonical) {
    const Orientations<Scalar> now = bone_orientations(skeleton, skeleton_template);
    const Orientations<Scalar> wanted = orientations_in(pose, skeleton_template, now, to_canonical);
    const Vector3<Scalar> origin = Vector3<Scalar>::Zero();
    if (pose == RestPose::as_is) return motions<Scalar>(skeleton, now, wanted, origin);
    const Orientations<Scalar> upright(now.size(), Eigen::Quaternion<Scalar>::Identity());
    return motions<Scalar>(
        skeleton, now, wanted, origin,
        girdle_turns(skeleton, now, rest_skeleton<Scalar>(skeleton_template), upright, skeleton_template));
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
