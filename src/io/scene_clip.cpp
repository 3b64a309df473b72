#include "scene_clip.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <skelgen/core/error.hpp>

namespace skelgen::io::detail {
namespace {

using applications::ClipChannel;
using applications::ClipJoint;
using applications::MotionClip;

[[noreturn]] void refuse(const std::string& message) { throw Error(ErrorCode::bad_input, message); }

/// How a matrix turns what it moves.
Eigen::Quaterniond turn_of(const Eigen::Matrix4d& matrix) {
    return Eigen::Quaterniond(Eigen::Affine3d(matrix).rotation());
}

/// Bones and what is above them, parents before children; with each its parent among them, or -1.
std::vector<std::pair<std::size_t, int>> chosen_nodes(const SceneMotion& motion) {
    const auto parent_of = [&](std::size_t node) { return motion.nodes[node].parent; };
    std::vector<bool> is_used(motion.nodes.size(), false);
    for (std::size_t n = 0; n < motion.nodes.size(); ++n)
        if (motion.is_bone[n])
            for (int up = static_cast<int>(n); up >= 0 && !is_used[static_cast<std::size_t>(up)];
                 up = parent_of(static_cast<std::size_t>(up)))
                is_used[static_cast<std::size_t>(up)] = true;
    std::vector<std::vector<std::size_t>> children(motion.nodes.size());
    std::vector<std::pair<std::size_t, int>> out;
    for (std::size_t n = 0; n < motion.nodes.size(); ++n) {
        if (!is_used[n]) continue;
        if (parent_of(n) < 0)
            out.emplace_back(n, -1);
        else
            children[static_cast<std::size_t>(parent_of(n))].push_back(n);
    }
    for (std::size_t i = 0; i < out.size(); ++i)
        for (const std::size_t child : children[out[i].first]) out.emplace_back(child, static_cast<int>(i));
    return out;
}

} // namespace

MotionClip clip_of(SceneMotion motion, std::optional<double> time) {
    constexpr double frames_per_second = 30, longest = 36000;
    constexpr double degrees = 180 / std::numbers::pi;
    const auto chosen = chosen_nodes(motion);
    if (time) {
        for (const AnimationChannel& channel : motion.channels)
            motion.nodes = animate(std::move(motion.nodes), channel, *time);
        motion.channels.clear();
    }
    double begin = longest, end = 0;
    for (const AnimationChannel& channel : motion.channels) {
        if (channel.times.empty()) continue;
        begin = std::min(begin, channel.times.front());
        end = std::max(end, channel.times.back());
    }
    if (chosen.empty()) refuse("has no skeleton; export it with one");
    if (time) begin = end;
    if (!(begin <= end)) refuse("has an animation that moves nothing; export it again");
    if (!(end - begin <= longest)) refuse("moves for more than ten hours; cut it");

    MotionClip clip;
    clip.seconds_per_frame = 1 / frames_per_second;
    const auto roots = std::count_if(chosen.begin(), chosen.end(), [](const auto& one) { return one.second < 0; });
    const int above = roots > 1 ? 1 : 0; // a joint of its own above several roots
    if (above > 0) clip.joints.push_back({"scene", -1, {}, {}, std::nullopt});
    const std::vector<Eigen::Matrix4d> rest = world_matrices(motion.nodes);
    std::vector<Eigen::Quaterniond> rest_turns;
    for (const auto& [node, parent] : chosen) {
        rest_turns.push_back(turn_of(rest[node]));
        using enum ClipChannel;
        const Eigen::Vector3d place = rest[node].topRightCorner<3, 1>();
        const Eigen::Vector3d from =
            parent < 0 ? Eigen::Vector3d(0, 0, 0)
                       : Eigen::Vector3d(rest[chosen[static_cast<std::size_t>(parent)].first].topRightCorner<3, 1>());
        clip.joints.push_back({motion.names[node],
                               parent < 0 ? above - 1 : parent + above,
                               place - from,
                               {x_position, y_position, z_position, z_rotation, x_rotation, y_rotation},
                               std::nullopt});
    }
    const auto frames = static_cast<Eigen::Index>(std::floor((end - begin) * frames_per_second + 1e-6)) + 1;
    constexpr Eigen::Index columns = 6, most_numbers = Eigen::Index{1} << 26;
    if (frames > most_numbers / (columns * static_cast<Eigen::Index>(chosen.size())))
        refuse("moves too many joints for too long; cut it");
    clip.frames.resize(frames, columns * static_cast<Eigen::Index>(chosen.size()));
    for (Eigen::Index f = 0; f < frames; ++f) {
        for (const AnimationChannel& channel : motion.channels)
            motion.nodes =
                animate(std::move(motion.nodes), channel, begin + static_cast<double>(f) / frames_per_second);
        const std::vector<Eigen::Matrix4d> now = world_matrices(motion.nodes);
        std::vector<Eigen::Quaterniond> turns;
        for (std::size_t j = 0; j < chosen.size(); ++j) {
            const auto& [node, parent] = chosen[j];
            turns.push_back(turn_of(now[node]) * rest_turns[j].conjugate());
            Eigen::Quaterniond back = Eigen::Quaterniond::Identity();
            Eigen::Vector3d place = now[node].topRightCorner<3, 1>();
            if (parent >= 0) {
                back = turns[static_cast<std::size_t>(parent)].conjugate();
                place -= now[chosen[static_cast<std::size_t>(parent)].first].topRightCorner<3, 1>();
            }
            auto row = clip.frames.row(f).segment<columns>(columns * static_cast<Eigen::Index>(j));
            row.head<3>() = (back * place).transpose();
            row.tail<3>() = degrees * (back * turns[j]).toRotationMatrix().eulerAngles(2, 0, 1).transpose();
        }
    }
    if (!clip.frames.allFinite()) refuse("moves a skeleton to places that are not finite; export it again");
    return clip;
}

} // namespace skelgen::io::detail
