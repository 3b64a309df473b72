#include "rig_motion.hpp"

#include <cstddef>
#include <string>

#include <skelgen/core/error.hpp>

namespace skelgen::io::detail {
namespace {

using applications::Animation;
using applications::Rig;

[[noreturn]] void refuse(const Animation<double>& animation, const std::string& message) {
    throw Error(ErrorCode::usage, "the animation \"" + animation.name + "\" cannot be written: " + message);
}

FloatRows times_of(const Animation<double>& animation) {
    FloatRows times(static_cast<Eigen::Index>(animation.frames.size()), 1);
    for (Eigen::Index i = 0; i < times.rows(); ++i)
        times(i, 0) = static_cast<float>(static_cast<double>(i) * animation.seconds_per_frame);
    for (Eigen::Index i = 1; i < times.rows(); ++i)
        if (!(times(i, 0) > times(i - 1, 0))) refuse(animation, "its frames follow each other too closely");
    if (!times.allFinite()) refuse(animation, "its frames are too far apart");
    return times;
}

/// The root's place in each frame.
FloatRows places_of(const Animation<double>& animation) {
    FloatRows rows(static_cast<Eigen::Index>(animation.frames.size()), 3);
    for (Eigen::Index i = 0; i < rows.rows(); ++i)
        rows.row(i) = animation.frames[static_cast<std::size_t>(i)].root.cast<float>().transpose();
    if (!rows.allFinite()) refuse(animation, "a place is too large for a float");
    return rows;
}

/// Where the hips are in each frame on the root that carries them.
FloatRows lifts_of(const Animation<double>& animation, const Eigen::Vector3d& at_rest) {
    FloatRows rows(static_cast<Eigen::Index>(animation.frames.size()), 3);
    for (Eigen::Index i = 0; i < rows.rows(); ++i) {
        const double lift = animation.frames[static_cast<std::size_t>(i)].lift;
        rows.row(i) = (at_rest + lift * Eigen::Vector3d::UnitY()).cast<float>().transpose();
    }
    if (!rows.allFinite()) refuse(animation, "a place is too large for a float");
    return rows;
}

/// How a joint is turned within its parent in each frame. Of the two quaternions of a rotation that which is nearer to
/// the frame before, so that also a reader which blends them number by number takes the short way.
FloatRows turns_of(const Animation<double>& animation, std::size_t joint, int parent) {
    FloatRows rows(static_cast<Eigen::Index>(animation.frames.size()), 4);
    Eigen::Vector4d last = Eigen::Vector4d::Zero();
    for (Eigen::Index i = 0; i < rows.rows(); ++i) {
        const applications::Orientations<double>& axes = animation.frames[static_cast<std::size_t>(i)].axes;
        Eigen::Quaterniond turn = axes[joint];
        if (parent >= 0) turn = axes[static_cast<std::size_t>(parent)].conjugate() * turn;
        const Eigen::Vector4d now = turn.normalized().coeffs(); // x, y, z, w, as glTF has them
        last = now.dot(last) < 0 ? Eigen::Vector4d(-now) : now;
        rows.row(i) = last.cast<float>().transpose();
    }
    return rows;
}

Json describe_animation(RigScene& scene, const Rig<double>& rig, const Animation<double>& animation) {
    for (const applications::RigPose<double>& frame : animation.frames)
        if (frame.axes.size() != rig.joints.size()) refuse(animation, "its poses are those of another rig");
    Json samplers = Json::array(), channels = Json::array();
    const std::size_t times = scene.buffer.add_floats(times_of(animation), GltfTarget::none, true);
    const auto add = [&](std::size_t joint, const char* path, const FloatRows& values) {
        channels.push_back(
            {{"sampler", samplers.size()}, {"target", {{"node", scene.joint_nodes[joint]}, {"path", path}}}});
        samplers.push_back({{"input", times},
                            {"output", scene.buffer.add_floats(values, GltfTarget::none)},
                            {"interpolation", "LINEAR"}});
    };
    for (std::size_t j = 0; j < rig.joints.size(); ++j) {
        const applications::RigJoint<double>& joint = rig.joints[j];
        if (joint.parent < 0)
            add(j, "translation", places_of(animation));
        else if (joint.role == JointRole::pelvis) // on a root that is on the floor, and is not turned
            add(j, "translation", lifts_of(animation, joint.position - rig.joints.front().position));
        add(j, "rotation", turns_of(animation, j, rig.joints[j].parent));
    }
    return {{"name", valid_utf8(animation.name)}, {"samplers", std::move(samplers)}, {"channels", std::move(channels)}};
}

} // namespace

void add_animations(RigScene& scene, const Rig<double>& rig, const std::vector<Animation<double>>& animations) {
    for (const Animation<double>& animation : animations)
        if (!animation.frames.empty()) scene.json["animations"].push_back(describe_animation(scene, rig, animation));
}

} // namespace skelgen::io::detail
