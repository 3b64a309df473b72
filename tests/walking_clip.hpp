#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

#include <Eigen/Geometry>

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

/// How a foot is held: where its ankle is, and by how much its heel is lifted about the toes, in radians.
struct FootPlace {
    Vector3<double> ankle;
    double lift = 0;
};

/// Where the ankle is from the joint of the toes, with the heel lifted so.
inline Vector3<double> ankle_from_toes(double lift) {
    return {0, 7 * std::cos(lift) + 13 * std::sin(lift), 7 * std::sin(lift) - 13 * std::cos(lift)};
}

/// Of someone who walks along z by `stride` in 30 frames, a foot that comes down in the frame `landing`, and every 30
/// frames: the toes stay where they are for 18 frames, over the last 7 of which the heel lifts, and then swing on.
inline FootPlace foot_of_walk(double x, double frame, double landing, double stride) {
    constexpr double cycle = 30, planted = 18, flat = 11, reach = 38, toe_height = 1, most_lift = 0.8;
    const double cycles = std::floor((frame - landing) / cycle), since = frame - landing - cycle * cycles;
    const double toes = stride * (landing / cycle + cycles) + reach; // where the hips are when it comes down, and ahead
    const auto on_toes = [&](double z, double lift) -> Vector3<double> {
        return Vector3<double>(x, toe_height, z) + ankle_from_toes(lift);
    };
    if (since < planted) {
        const double rise = std::max(0.0, since - flat) / (planted - flat), lift = most_lift * rise * rise;
        return {on_toes(toes, lift), lift};
    }
    const double u = (since - planted) / (cycle - planted), smooth = u * u * (3 - 2 * u);
    const double bump = std::sin(std::numbers::pi * u);
    Vector3<double> ankle = (1 - smooth) * on_toes(toes, most_lift) + smooth * on_toes(toes + stride, 0);
    ankle.y() += 5 * bump * bump;
    return {ankle, most_lift * (1 - smooth) - 0.15 * bump};
}

/// The turns about z, x and y, one after another in a file, that a rotation is made of, in degrees.
inline Vector3<double> zxy_angles(const Eigen::Matrix3d& turn) {
    const Vector3<double> radians(std::atan2(-turn(0, 1), turn(1, 1)), std::asin(std::clamp(turn(2, 1), -1.0, 1.0)),
                                  std::atan2(-turn(2, 0), turn(2, 2)));
    return radians * 180 / std::numbers::pi;
}

/// Turns a leg of `standing_clip` so that its foot is there; the hips are set already.
inline void put_foot(applications::MotionClip& clip, Eigen::Index frame, const std::string& side,
                     const FootPlace& foot) {
    const applications::ClipPose pose = pose_in(clip, static_cast<std::size_t>(frame));
    const auto number = [&](const std::string& name) {
        return static_cast<std::size_t>(
            std::find_if(clip.joints.begin(), clip.joints.end(), [&](const auto& j) { return j.name == side + name; }) -
            clip.joints.begin());
    };
    const Eigen::Matrix3d hips = pose.turns.front().toRotationMatrix();
    const auto about = [](double angle, const Vector3<double>& axis) {
        return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
    };
    const Vector3<double> x = Vector3<double>::UnitX(), z = Vector3<double>::UnitZ();
    const Vector3<double> way = hips.transpose() * (foot.ankle - pose.positions[number("UpLeg")]);
    const Vector3<double> thigh = clip.joints[number("Leg")].offset, calf = clip.joints[number("Foot")].offset;
    double least = 0, most = 2; // of the knee's bend, which makes the leg as long as the way
    for (int round = 0; round < 60; ++round) {
        const double middle = (least + most) / 2;
        ((thigh + about(middle, x) * calf).norm() > way.norm() ? least : most) = middle;
    }
    const Vector3<double> leg = thigh + about(least, x) * calf;
    const double down = -std::sqrt(leg.squaredNorm() - way.z() * way.z());
    const double forwards = std::atan2(way.z(), down) - std::atan2(leg.z(), leg.y());
    const Eigen::Matrix3d above = about(std::asin(-way.x() / down), z) * about(forwards, x);
    const auto set = [&](const std::string& name, const Eigen::Matrix3d& turn) {
        const Vector3<double> angles = zxy_angles(turn);
        for (int axis = 0; axis < 3; ++axis) turn_of(clip, frame, side + name, axis) = angles[axis];
    };
    set("UpLeg", above);
    set("Leg", about(least, x));
    set("Foot", (hips * above * about(least, x)).transpose() * about(foot.lift, x));
}

/// The same person walking forwards: two steps in 30 frames of a second together, numbers rounded to hundredths. One
/// foot at least is always on the floor, y = 0, and the toes that are there stay where they are.
inline applications::MotionClip walking_clip() {
    constexpr int frames = 30;
    constexpr double stride = 110;
    applications::MotionClip clip = standing_clip();
    clip.frames.setZero(frames, clip.frames.cols());
    for (Eigen::Index f = 0; f < frames; ++f) {
        const auto frame = static_cast<double>(f);
        const double phase = 2 * std::numbers::pi * frame / frames;
        turn_of(clip, f, "Hips", 2) = -6 * std::sin(phase);
        turn_of(clip, f, "Spine1", 2) = 10 * std::sin(phase);
        turn_of(clip, f, "Spine", 1) = 3;
        clip.frames(f, 1) = 92.3 + 1.7 * std::cos(2 * phase - 0.2 * std::numbers::pi); // highest over one foot alone
        clip.frames(f, 2) = stride * frame / frames;
        for (const bool is_left : {true, false}) {
            const std::string side = is_left ? "Left" : "Right";
            const double x = is_left ? 1 : -1, own = is_left ? phase : phase + std::numbers::pi;
            put_foot(clip, f, side, foot_of_walk(9 * x, frame, is_left ? 7.5 : 22.5, stride));
            turn_of(clip, f, side + "Arm", 0) = -72 * x;
            turn_of(clip, f, side + "Arm", 2) = 22 * x * std::sin(own); // against the leg
            turn_of(clip, f, side + "ForeArm", 2) = -25 * x;
        }
    }
    clip.frames = (100 * clip.frames.array()).round() / 100;
    return clip;
}

} // namespace skelgen::test
