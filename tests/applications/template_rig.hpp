#pragma once

#include <skelgen/applications/impl/bones.hpp>
#include <skelgen/applications/posing.hpp>
#include <skelgen/applications/rig.hpp>
#include <skelgen/core/builtin_templates.hpp>

namespace skelgen::test {

/// human21's joints as the template has them.
inline decltype(applications::Rig<double>::joints) template_joints() {
    const SkeletonTemplate& human = builtin_template("human21");
    const auto axes = applications::rest_axes<double>(human);
    decltype(applications::Rig<double>::joints) out;
    for (std::size_t j = 0; j < human.joints.size(); ++j) {
        const TemplateJoint& joint = human.joints[j];
        out.push_back({joint.name, joint.parent, joint.role, joint.side, joint.position,
                       joint.tip ? *joint.tip : joint.position, axes[j]});
    }
    return out;
}

/// A rig of human21's joints in a rest pose: one triangle for each joint, from it to its bone's end and to its parent.
inline applications::Rig<double> template_rig(applications::RestPose rest) {
    const SkeletonTemplate& human = builtin_template("human21");
    const auto skeleton = applications::rest_skeleton<double>(human);
    const applications::Orientations<double> from(21, Eigen::Quaterniond::Identity());
    const auto to = applications::orientations_in<double>(rest, human, from, Eigen::Quaterniond::Identity());
    const auto motion = applications::motions<double>(skeleton, from, to, skeleton.joints[0].position);
    const auto axes = applications::rest_axes<double>(human);
    applications::Rig<double> rig;
    rig.rest = rest;
    rig.unit_is_known = true;
    rig.mesh.vertices.resize(63, 3);
    rig.mesh.faces.resize(21, 3);
    Eigen::MatrixXd weights = Eigen::MatrixXd::Zero(63, 21);
    for (int j = 0; j < 21; ++j) {
        const auto i = static_cast<std::size_t>(j);
        const TemplateJoint& joint = human.joints[i];
        const Eigen::Vector3d place = motion[i](joint.position),
                              end = motion[i](applications::bone_end(skeleton, human, j));
        const Eigen::Vector3d back = motion[i](human.joint(std::max(joint.parent, 0)).position);
        rig.joints.push_back({joint.name, joint.parent, joint.role, joint.side, place, end, to[i] * axes[i], 1, to[i]});
        rig.mesh.vertices.row(3 * j) = place;
        rig.mesh.vertices.row(3 * j + 1) = end;
        rig.mesh.vertices.row(3 * j + 2) = back;
        rig.mesh.faces.row(j) << 3 * j, 3 * j + 1, 3 * j + 2;
        weights.block<3, 1>(3 * j, j).setOnes();
    }
    rig.skin = applications::strongest_influences<double>(weights);
    return rig;
}

} // namespace skelgen::test
