#pragma once

#include <skelgen/applications/posing.hpp>

#include <cstddef>
#include <numbers>
#include <optional>

#include <skelgen/applications/impl/bones.hpp>
#include <skelgen/core/error.hpp>
#include <skelgen/core/shoulder_height.hpp>

namespace skelgen::applications {
namespace detail {

template <typename Scalar>
std::vector<Vector3<Scalar>> lines_from_parents(const KinematicSkeleton<Scalar>& skeleton) {
    std::vector<Vector3<Scalar>> out;
    for (const Joint<Scalar>& joint : skeleton.joints) {
        const int from = joint.parent;
        out.push_back(from < 0
                          ? Vector3<Scalar>(Vector3<Scalar>::Zero())
                          : Vector3<Scalar>(joint.position - skeleton.joints[static_cast<std::size_t>(from)].position));
    }
    return out;
}

/// How much higher the shoulders of a body at rest, with +y up, are to be: as high as people hold them with arms so
/// `raised`.
template <typename Scalar>
Scalar way_to_usual_height(const KinematicSkeleton<Scalar>& rest, const SkeletonTemplate& skeleton_template,
                           Scalar raised) {
    const auto mean_height = [&](JointRole role) {
        Scalar sum = 0, count = 0;
        for (std::size_t j = 0; j < rest.joints.size(); ++j) {
            if (skeleton_template.joints[j].role != role || !rest.joints[j].is_present) continue;
            sum += rest.joints[j].position[1];
            count += 1;
        }
        return count > 0 ? std::optional<Scalar>(sum / count) : std::nullopt;
    };
    const auto neck = mean_height(JointRole::neck), hips = mean_height(JointRole::hip),
               shoulders = mean_height(JointRole::shoulder);
    if (!neck || !hips || !shoulders) return 0;
    return *neck + (*neck - *hips) * core::usual_shoulder_height(raised, Scalar(0)) - *shoulders;
}

template <typename Scalar>
std::vector<Vector3<Scalar>> with_shoulders_higher(std::vector<Vector3<Scalar>> lines, Scalar higher,
                                                   const std::vector<RigidMotion<Scalar>>& motions,
                                                   const SkeletonTemplate& skeleton_template) {
    std::vector<std::size_t> shoulders;
    Scalar was = 0, is = 0;
    for (std::size_t j = 0; j < lines.size(); ++j) {
        const TemplateJoint& joint = skeleton_template.joints[j];
        if (joint.role != JointRole::shoulder) continue;
        shoulders.push_back(j);
        was += lines[j].norm();
        lines[j] +=
            motions[static_cast<std::size_t>(joint.parent)].rotation.conjugate() * Vector3<Scalar>(0, higher, 0);
        is += lines[j].norm();
    }
    for (const std::size_t j : shoulders)
        if (is > 0) lines[j] *= was / is;
    return lines;
}

} // namespace detail

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
std::vector<Vector3<Scalar>> girdle_lines(const KinematicSkeleton<Scalar>& skeleton, const Orientations<Scalar>& from,
                                          const KinematicSkeleton<Scalar>& model, const Orientations<Scalar>& to,
                                          const SkeletonTemplate& skeleton_template) {
    const std::size_t count = skeleton_template.joints.size();
    for (const std::size_t size : {skeleton.joints.size(), model.joints.size(), from.size(), to.size()})
        if (size != count) throw Error(ErrorCode::usage, "a skeleton's joints must be the template's");
    std::vector<Vector3<Scalar>> out = detail::lines_from_parents(skeleton);
    const std::vector<Vector3<Scalar>> wanted = detail::lines_from_parents(model);
    std::vector<std::size_t> shoulders;
    Scalar length = 0, of_model = 0; // of all of them
    for (std::size_t j = 0; j < count; ++j) {
        if (skeleton_template.joints[j].role != JointRole::shoulder) continue;
        if (!skeleton.joints[j].is_present || !model.joints[j].is_present) continue;
        shoulders.push_back(j);
        length += out[j].norm();
        of_model += wanted[j].norm();
    }
    if (!(of_model > 0)) return out;
    for (const std::size_t j : shoulders) {
        const auto parent = static_cast<std::size_t>(skeleton_template.joints[j].parent);
        out[j] = length / of_model * (from[parent] * (to[parent].conjugate() * wanted[j]));
    }
    return out;
}

template <typename Scalar>
std::vector<RigidMotion<Scalar>> motions(const KinematicSkeleton<Scalar>& skeleton, const Orientations<Scalar>& from,
                                         const Orientations<Scalar>& to, const Vector3<Scalar>& root,
                                         const std::vector<Vector3<Scalar>>& lines) {
    const std::size_t count = skeleton.joints.size();
    if (from.size() != count || to.size() != count || (!lines.empty() && lines.size() != count))
        throw Error(ErrorCode::usage, "a pose must have as many orientations as the skeleton has joints");
    std::vector<RigidMotion<Scalar>> out;
    for (std::size_t j = 0; j < count; ++j) {
        const Joint<Scalar>& joint = skeleton.joints[j];
        Vector3<Scalar> place = root;
        if (joint.parent >= 0) {
            const auto parent = static_cast<std::size_t>(joint.parent);
            place = out[parent](lines.empty() ? joint.position
                                              : Vector3<Scalar>(skeleton.joints[parent].position + lines[j]));
        }
        RigidMotion<Scalar> motion;
        motion.rotation = (to[j] * from[j].conjugate()).normalized();
        motion.translation = place - motion.rotation * joint.position;
        out.push_back(motion);
    }
    return out;
}

template <typename Scalar>
std::vector<RigidMotion<Scalar>>
rest_motions(RestPose pose, const KinematicSkeleton<Scalar>& skeleton, const SkeletonTemplate& skeleton_template,
             const Orientations<Scalar>& now, const Eigen::Quaternion<Scalar>& to_canonical) {
    const Orientations<Scalar> wanted = orientations_in(pose, skeleton_template, now, to_canonical);
    const Vector3<Scalar> origin = Vector3<Scalar>::Zero();
    if (pose == RestPose::as_is) return motions<Scalar>(skeleton, now, wanted, origin);
    const Orientations<Scalar> upright(now.size(), Eigen::Quaternion<Scalar>::Identity());
    const auto lines =
        girdle_lines(skeleton, now, rest_skeleton<Scalar>(skeleton_template), upright, skeleton_template);
    const auto level = motions<Scalar>(skeleton, now, wanted, origin, lines);
    const Scalar raised = pose == RestPose::a_pose ? -std::numbers::sqrt2_v<Scalar> / 2 : Scalar(0);
    const Scalar higher =
        detail::way_to_usual_height(moved(skeleton, skeleton_template, level), skeleton_template, raised);
    return motions<Scalar>(skeleton, now, wanted, origin,
                           detail::with_shoulders_higher(lines, higher, level, skeleton_template));
}

template <typename Scalar>
KinematicSkeleton<Scalar> moved(const KinematicSkeleton<Scalar>& skeleton, const SkeletonTemplate& skeleton_template,
                                const std::vector<RigidMotion<Scalar>>& motions) {
    KinematicSkeleton<Scalar> out = skeleton;
    for (std::size_t j = 0; j < out.joints.size(); ++j) {
        out.joints[j].position = motions[j](skeleton.joints[j].position);
        const TemplateJoint& joint = skeleton_template.joints[j];
        for (auto& [name, place] : out.end_points)
            if (ends_limb(joint.role) && name == end_point_name(skeleton_template, joint)) place = motions[j](place);
    }
    const RigidMotion<Scalar>& root = motions.front();
    out.frame = {root(skeleton.frame.origin), root.rotation * skeleton.frame.left,
                 root.rotation * skeleton.frame.forward, root.rotation * skeleton.frame.up};
    return out;
}

} // namespace skelgen::applications
