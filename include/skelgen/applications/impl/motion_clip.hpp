#pragma once

#include <skelgen/applications/motion_clip.hpp>

#include <cstddef>
#include <numbers>
#include <string>

#include <skelgen/core/error.hpp>
#include <skelgen/core/header_only.hpp>

namespace skelgen::applications {
namespace detail {

/// Appends the place of a joint, which has turned and moved so within its parent.
inline void append_clip_joint(ClipPose& pose, int parent, const Eigen::Quaterniond& turn,
                              const Vector3<double>& offset) {
    if (parent < 0) {
        pose.turns.push_back(turn);
        pose.positions.push_back(offset);
        return;
    }
    const auto above = static_cast<std::size_t>(parent);
    pose.positions.emplace_back(pose.positions[above] + pose.turns[above] * offset);
    pose.turns.push_back((pose.turns[above] * turn).normalized());
}

} // namespace detail

SKELGEN_INLINE void validate(const MotionClip& clip) {
    std::size_t channels = 0;
    for (std::size_t j = 0; j < clip.joints.size(); ++j) {
        if (const int parent = clip.joints[j].parent; parent < -1 || parent >= static_cast<int>(j))
            throw Error(ErrorCode::usage, "a clip's joints must come after their parents");
        channels += clip.joints[j].channels.size();
    }
    if (channels != static_cast<std::size_t>(clip.frames.cols()))
        throw Error(ErrorCode::usage, "a clip's frames must have as many numbers as its joints have channels");
}

SKELGEN_INLINE ClipPose rest_pose(const MotionClip& clip) {
    validate(clip);
    ClipPose pose;
    for (const ClipJoint& joint : clip.joints)
        detail::append_clip_joint(pose, joint.parent, Eigen::Quaterniond::Identity(), joint.offset);
    return pose;
}

SKELGEN_INLINE ClipPose pose_in(const MotionClip& clip, std::size_t frame) {
    const auto frames = static_cast<std::size_t>(clip.frames.rows());
    if (frame >= frames)
        throw Error(ErrorCode::usage, "there is no frame " + std::to_string(frame) + ": the clip has " +
                                          std::to_string(frames) + ", counted from 0");
    validate(clip);
    constexpr double radians = std::numbers::pi / 180;
    const double* value = clip.frames.data() + static_cast<Eigen::Index>(frame) * clip.frames.cols();
    ClipPose pose;
    for (const ClipJoint& joint : clip.joints) {
        Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();
        Vector3<double> offset = joint.offset;
        for (const ClipChannel channel : joint.channels) {
            const int axis = static_cast<int>(channel) % 3;
            if (channel <= ClipChannel::z_position)
                offset[axis] = *value;
            else
                turn = turn * Eigen::Quaterniond(Eigen::AngleAxisd(radians * *value, Vector3<double>::Unit(axis)));
            ++value;
        }
        detail::append_clip_joint(pose, joint.parent, turn, offset);
    }
    return pose;
}

} // namespace skelgen::applications
