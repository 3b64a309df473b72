#include "scene_pose.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include <skelgen/core/error.hpp>

namespace skelgen::io::detail {
namespace {

[[noreturn]] void refuse(const std::string& message) {
    throw Error(ErrorCode::bad_input, message + "; repair or export the scene again");
}

/// The node with translation, rotation and scale in place of its matrix.
SceneNode taken_apart(SceneNode node) {
    if (!node.matrix) return node;
    Eigen::Matrix3d axes = node.matrix->topLeftCorner<3, 3>();
    node.translation = node.matrix->topRightCorner<3, 1>();
    node.scale = axes.colwise().norm();
    if (axes.determinant() < 0) node.scale[0] = -node.scale[0];
    for (int i = 0; i < 3; ++i)
        if (node.scale[i] != 0) axes.col(i) /= node.scale[i];
    node.rotation = Eigen::Quaterniond(axes).normalized();
    node.matrix.reset();
    return node;
}

Eigen::Matrix4d local_matrix(const SceneNode& node) {
    if (node.matrix) return *node.matrix;
    Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
    matrix.topLeftCorner<3, 3>() = node.rotation.toRotationMatrix() * node.scale.asDiagonal();
    matrix.topRightCorner<3, 1>() = node.translation;
    return matrix;
}

/// Nodes so that parents come before children.
std::vector<std::size_t> parents_first(const std::vector<SceneNode>& nodes) {
    std::vector<std::vector<std::size_t>> children(nodes.size());
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (nodes[i].parent < 0)
            order.push_back(i);
        else
            children[static_cast<std::size_t>(nodes[i].parent)].push_back(i);
    }
    for (std::size_t i = 0; i < order.size(); ++i)
        order.insert(order.end(), children[order[i]].begin(), children[order[i]].end());
    if (order.size() != nodes.size()) refuse("a node of the scene is its own ancestor");
    return order;
}

/// The place of a time between two keys.
struct KeySpan {
    std::size_t first = 0, second = 0;
    double seconds = 0; ///< from the first to the second
    double part = 0;    ///< how much of that has passed, 0 to 1
};

KeySpan find_span(const std::vector<double>& times, double time) {
    const auto after = std::upper_bound(times.begin(), times.end(), time);
    const auto second = static_cast<std::size_t>(after - times.begin());
    if (second == 0) return {0, 0, 0, 0};
    if (second == times.size()) return {second - 1, second - 1, 0, 0};
    const double seconds = times[second] - times[second - 1];
    return {second - 1, second, seconds, (time - times[second - 1]) / seconds};
}

Eigen::Quaterniond to_quaternion(const std::vector<double>& v) {
    const Eigen::Quaterniond rotation(v[3], v[0], v[1], v[2]);
    return rotation.norm() > 0 ? rotation.normalized() : Eigen::Quaterniond::Identity();
}

/// The values of a channel at a time.
class Sampler {
public:
    explicit Sampler(const AnimationChannel& channel)
        : channel_(channel), parts_(channel.interpolation == Interpolation::cubic ? 3 : 1),
          width_(channel.values.size() / (channel.times.size() * parts_)) {}

    [[nodiscard]] std::vector<double> at(double time) const {
        const KeySpan span = find_span(channel_.times, time);
        if (span.first == span.second || channel_.interpolation == Interpolation::step) return key(span.first, value());
        if (channel_.interpolation == Interpolation::cubic) return cubic(span);
        if (channel_.property == AnimatedProperty::rotation) return spherical(span);
        std::vector<double> mix = key(span.first, value());
        const std::vector<double> next = key(span.second, value());
        for (std::size_t i = 0; i < mix.size(); ++i) mix[i] += span.part * (next[i] - mix[i]);
        return mix;
    }

private:
    /// Which of a key's parts is its value: the one between the tangents.
    [[nodiscard]] std::size_t value() const { return parts_ / 2; }

    [[nodiscard]] std::vector<double> key(std::size_t i, std::size_t part) const {
        const auto from = channel_.values.begin() + static_cast<std::ptrdiff_t>((i * parts_ + part) * width_);
        return {from, from + static_cast<std::ptrdiff_t>(width_)};
    }

    [[nodiscard]] std::vector<double> spherical(const KeySpan& span) const {
        const Eigen::Quaterniond a = to_quaternion(key(span.first, value()));
        const Eigen::Quaterniond b = to_quaternion(key(span.second, value()));
        const Eigen::Quaterniond mix = a.slerp(span.part, b);
        return {mix.x(), mix.y(), mix.z(), mix.w()};
    }

    /// Hermite's cubic; tangents are per second.
    [[nodiscard]] std::vector<double> cubic(const KeySpan& span) const {
        const double t = span.part, t2 = t * t, t3 = t2 * t;
        const std::vector<double> a = key(span.first, 1), b = key(span.second, 1);
        const std::vector<double> out = key(span.first, 2), in = key(span.second, 0);
        std::vector<double> mix(width_);
        for (std::size_t i = 0; i < width_; ++i)
            mix[i] = (2 * t3 - 3 * t2 + 1) * a[i] + (t3 - 2 * t2 + t) * span.seconds * out[i] +
                     (3 * t2 - 2 * t3) * b[i] + (t3 - t2) * span.seconds * in[i];
        return mix;
    }

    const AnimationChannel& channel_;
    std::size_t parts_; ///< values that a key has: with tangents three
    std::size_t width_; ///< numbers of a value
};

void check(const AnimationChannel& channel) {
    const std::size_t parts = channel.interpolation == Interpolation::cubic ? 3 : 1;
    const std::size_t keys = channel.times.size() * parts;
    if (keys == 0 || channel.values.empty() || channel.values.size() % keys != 0)
        refuse("an animation's values do not fit its times");
    if (std::adjacent_find(channel.times.begin(), channel.times.end(), std::greater_equal<>()) != channel.times.end() ||
        !std::all_of(channel.times.begin(), channel.times.end(), [](double t) { return std::isfinite(t); }))
        refuse("an animation's times do not rise");
    const std::size_t width = channel.values.size() / keys;
    const bool fits = channel.property == AnimatedProperty::weights ||
                      width == (channel.property == AnimatedProperty::rotation ? 4U : 3U);
    if (!fits) refuse("an animation's values do not fit what they animate");
}

} // namespace

std::vector<Eigen::Matrix4d> world_matrices(const std::vector<SceneNode>& nodes) {
    std::vector<Eigen::Matrix4d> matrices(nodes.size());
    for (const std::size_t i : parents_first(nodes)) {
        matrices[i] = local_matrix(nodes[i]);
        if (nodes[i].parent >= 0) matrices[i] = matrices[static_cast<std::size_t>(nodes[i].parent)] * matrices[i];
    }
    return matrices;
}

std::vector<SceneNode> animate(std::vector<SceneNode> nodes, const AnimationChannel& channel, double time) {
    check(channel);
    SceneNode& node = nodes.at(channel.node);
    const std::vector<double> values = Sampler(channel).at(time);
    if (channel.property != AnimatedProperty::weights) node = taken_apart(std::move(node));
    switch (channel.property) {
    case AnimatedProperty::translation:
        node.translation = Eigen::Vector3d(values[0], values[1], values[2]);
        break;
    case AnimatedProperty::rotation:
        node.rotation = to_quaternion(values);
        break;
    case AnimatedProperty::scale:
        node.scale = Eigen::Vector3d(values[0], values[1], values[2]);
        break;
    case AnimatedProperty::weights:
        node.weights = values;
        break;
    }
    return nodes;
}

Eigen::Vector3d skinned(const Eigen::Vector3d& point, std::span<const Influence> influences,
                        const std::vector<Eigen::Matrix4d>& joint_matrices) {
    double sum = 0;
    for (const Influence& influence : influences) sum += influence.weight;
    if (influences.empty()) return point;
    if (sum == 0) return transformed(point, joint_matrices[influences.front().joint]);
    Eigen::Vector3d moved = Eigen::Vector3d::Zero();
    for (const Influence& influence : influences)
        if (influence.weight != 0)
            moved += influence.weight / sum * transformed(point, joint_matrices[influence.joint]);
    return moved;
}

namespace {

/// What turns directions across a surface when the matrix moves it, whatever their length. Along the cofactors, which
/// are there where the inverse is not: they are it, transposed, times the determinant.
Eigen::Matrix3d normal_matrix(const Eigen::Matrix3d& linear) {
    Eigen::Matrix3d cofactors;
    for (int axis = 0; axis < 3; ++axis)
        cofactors.col(axis) = linear.col((axis + 1) % 3).cross(linear.col((axis + 2) % 3));
    return (linear.determinant() < 0 ? -1.0 : 1.0) * cofactors;
}

} // namespace

Eigen::Vector3d transformed_normal(const Eigen::Vector3d& normal, const Eigen::Matrix4d& matrix) {
    const Eigen::Vector3d turned = normal_matrix(matrix.topLeftCorner<3, 3>()) * normal;
    const double length = turned.stableNorm();
    if (!std::isfinite(length) || length == 0) return Eigen::Vector3d::Zero();
    return turned / length;
}

Eigen::Vector3d transformed_normal_offset(const Eigen::Vector3d& offset, const Eigen::Vector3d& normal,
                                          const Eigen::Matrix3d& linear) {
    const Eigen::Matrix3d matrix = normal_matrix(linear);
    const Eigen::Vector3d turned = matrix * normal;
    const double length = turned.stableNorm();
    if (!std::isfinite(length) || length == 0) return Eigen::Vector3d::Zero();
    return matrix * offset / length;
}

Eigen::Matrix4d blended(std::span<const Influence> influences, const std::vector<Eigen::Matrix4d>& joint_matrices,
                        const Eigen::Matrix4d& alone) {
    double sum = 0;
    for (const Influence& influence : influences) sum += influence.weight;
    if (influences.empty()) return alone;
    if (sum == 0) return joint_matrices[influences.front().joint];
    Eigen::Matrix4d matrix = Eigen::Matrix4d::Zero();
    for (const Influence& influence : influences)
        if (influence.weight != 0) matrix += influence.weight / sum * joint_matrices[influence.joint];
    return matrix;
}

Eigen::Vector3d skinned_normal(const Eigen::Vector3d& normal, std::span<const Influence> influences,
                               const std::vector<Eigen::Matrix4d>& joint_matrices) {
    return transformed_normal(normal, blended(influences, joint_matrices, Eigen::Matrix4d::Identity()));
}

} // namespace skelgen::io::detail
