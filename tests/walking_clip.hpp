#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include <skelgen/applications/motion_clip.hpp>

namespace skelgen::test {

/// A person of 1.7 m in centimetres, at rest in the T-pose, +y up and facing +z, joints named as MotionBuilder does.
inline applications::MotionClip standing_clip() {
    using enum applications::ClipChannel;
    struct Row {
        const char* name;
        int parent;
        Vector3<double> offset, end = Vector3<double>::Zero();
    };
    std::vector<Row> rows{{"Hips", -1, {0, 0, 0}},   {"Spine", 0, {0, 10, -1}}, {"Spine1", 1, {0, 11, 0}},
                          {"Spine2", 2, {0, 12, 0}}, {"Neck", 3, {0, 20, 0}},   {"Head", 4, {0, 8, 2}, {0, 19, 0}}};
    for (const double x : {1, -1}) {
        const auto first = static_cast<int>(rows.size());
        const std::vector<Row> arm{{"Shoulder", 3, {4 * x, 14, 0}},
                                   {"Arm", first, {13 * x, 0, 0}},
                                   {"ForeArm", first + 1, {27 * x, 0, 0}},
                                   {"Hand", first + 2, {25 * x, 0, 0}, {18 * x, 0, 0}}};
        rows.insert(rows.end(), arm.begin(), arm.end());
    }
    for (const double x : {1, -1}) {
        const auto first = static_cast<int>(rows.size());
        const std::vector<Row> leg{{"UpLeg", 0, {9 * x, -7, 0}},
                                   {"Leg", first, {0, -41, 0}},
                                   {"Foot", first + 1, {0, -40, -1}},
                                   {"ToeBase", first + 2, {0, -7, 13}, {0, 0, 7}}};
        rows.insert(rows.end(), leg.begin(), leg.end());
    }
    applications::MotionClip clip;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const std::string side = i < 6 ? "" : (i - 6) / 4 % 2 == 0 ? "Left" : "Right";
        clip.joints.push_back(
            {side + rows[i].name, rows[i].parent, rows[i].offset, {z_rotation, x_rotation, y_rotation}});
        if (!rows[i].end.isZero()) clip.joints.back().end = rows[i].end;
    }
    clip.joints[0].channels = {x_position, y_position, z_position, z_rotation, x_rotation, y_rotation};
    clip.frames.setZero(1, static_cast<Eigen::Index>(3 + 3 * rows.size()));
    clip.frames(0, 1) = 96;
    return clip;
}

/// The number of a clip's frame that turns a joint about z (0), x (1) or y (2), where all have their channels so.
inline double& turn_of(applications::MotionClip& clip, Eigen::Index frame, const std::string& joint, int axis) {
    const auto at =
        std::find_if(clip.joints.begin(), clip.joints.end(), [&](const auto& j) { return j.name == joint; });
    return clip.frames(frame, 3 + 3 * (at - clip.joints.begin()) + axis);
}

/// The height of the lower foot's lowest joint in a frame.
inline double lowest_foot(const applications::MotionClip& clip, Eigen::Index frame) {
    const applications::ClipPose pose = pose_in(clip, static_cast<std::size_t>(frame));
    double lowest = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < clip.joints.size(); ++j)
        if (clip.joints[j].name.ends_with("ToeBase") || clip.joints[j].name.ends_with("Foot"))
            lowest = std::min(lowest, pose.positions[j].y() - (clip.joints[j].name.ends_with("Foot") ? 8.0 : 1.0));
    return lowest;
}

/// The same person walking forwards: two steps in 30 frames of a second together, numbers rounded to hundredths. One
/// foot is always on the floor, y = 0.
inline applications::MotionClip walking_clip() {
    constexpr int frames = 30;
    applications::MotionClip clip = standing_clip();
    clip.frames.setZero(frames, clip.frames.cols());
    for (Eigen::Index f = 0; f < frames; ++f) {
        const double phase = 2 * std::numbers::pi * static_cast<double>(f) / frames;
        for (const bool is_left : {true, false}) {
            const std::string side = is_left ? "Left" : "Right";
            const double x = is_left ? 1 : -1, own = is_left ? phase : phase + std::numbers::pi;
            const double swing = (1 + std::cos(own + 0.35)) / 2, stance = (1 - std::cos(own)) / 2;
            const double thigh = -5 - 25 * std::sin(own), knee = 5 + 55 * swing * swing;
            turn_of(clip, f, side + "UpLeg", 1) = thigh;
            turn_of(clip, f, side + "Leg", 1) = knee;
            turn_of(clip, f, side + "Foot", 1) = -(thigh + knee) * stance;
            turn_of(clip, f, side + "Arm", 0) = -72 * x;
            turn_of(clip, f, side + "Arm", 2) = 22 * x * std::sin(own); // against the leg
            turn_of(clip, f, side + "ForeArm", 2) = -25 * x;
        }
        turn_of(clip, f, "Hips", 2) = -6 * std::sin(phase);
        turn_of(clip, f, "Spine1", 2) = 10 * std::sin(phase);
        turn_of(clip, f, "Spine", 1) = 3;
        clip.frames(f, 2) = 130 * static_cast<double>(f) / frames;
        clip.frames(f, 1) = 0;
        clip.frames(f, 1) = -lowest_foot(clip, f);
    }
    clip.frames = (100 * clip.frames.array()).round() / 100;
    return clip;
}

} // namespace skelgen::test
