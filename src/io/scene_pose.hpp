#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

/// Nodes, skins and animations: what scene formats have in common. Poses follow Khr21 sections 3.5 to 3.7 and 3.11 and
/// appendix C.
namespace skelgen::io::detail {

/// A node of a scene: where it is in its parent.
struct SceneNode {
    int parent = -1; ///< -1: none
    Eigen::Vector3d translation = Eigen::Vector3d::Zero();
    Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
    Eigen::Vector3d scale = Eigen::Vector3d::Ones();
    std::optional<Eigen::Matrix4d> matrix; ///< in place of the three above; affine
    std::vector<double> weights;           ///< of its mesh's morph targets
};

/// The matrix of each node in the whole scene. A node may come before its parent. Linear in the nodes' number.
/// \throws Error bad_input when a node is its own ancestor.
[[nodiscard]] std::vector<Eigen::Matrix4d> world_matrices(const std::vector<SceneNode>& nodes);

enum class AnimatedProperty { translation, rotation, scale, weights };
enum class Interpolation { step, linear, cubic };

/// How one property of one node changes with time.
struct AnimationChannel {
    std::size_t node = 0;
    AnimatedProperty property = AnimatedProperty::translation;
    Interpolation interpolation = Interpolation::linear;
    std::vector<double> times;  ///< seconds, rising
    std::vector<double> values; ///< per time so many as the property has; cubic: tangent in, value, tangent out
};

/// The nodes with the channel's property as it is at `time`; before the first key as at the first, behind the last as
/// at the last. A rotation is a unit quaternion x, y, z, w. A node with a matrix gets it taken apart: shear is lost.
/// \throws Error bad_input when values do not fit times, or times do not rise.
[[nodiscard]] std::vector<SceneNode> animate(std::vector<SceneNode> nodes, const AnimationChannel& channel,
                                             double time);

/// The joints that move a vertex, and how much.
struct Influence {
    std::size_t joint = 0; ///< index into the skin's matrices
    double weight = 0;
};

/// A point moved by its joints: the mean of where each moves it, by their weights, which are brought to the sum of 1;
/// where they sum to 0 the first joint alone moves it.
[[nodiscard]] Eigen::Vector3d skinned(const Eigen::Vector3d& point, std::span<const Influence> influences,
                                      const std::vector<Eigen::Matrix4d>& joint_matrices);

/// The direction across a surface once the matrix has moved it, of unit length; zero where it has none, or the surface
/// none. A surface that the matrix mirrors is taken to be turned over, as its faces are.
[[nodiscard]] Eigen::Vector3d transformed_normal(const Eigen::Vector3d& normal, const Eigen::Matrix4d& matrix);

/// What is added to that direction where `offset` is added to `normal` itself: to first order, and as if the length
/// that the result is brought to were that which it has without.
[[nodiscard]] Eigen::Vector3d transformed_normal_offset(const Eigen::Vector3d& offset, const Eigen::Vector3d& normal,
                                                        const Eigen::Matrix3d& linear);

/// The mean of the joints' matrices by the weights that a point has of them, as `skinned` moves it; `alone` where there
/// are no influences.
[[nodiscard]] Eigen::Matrix4d blended(std::span<const Influence> influences,
                                      const std::vector<Eigen::Matrix4d>& joint_matrices, const Eigen::Matrix4d& alone);

/// The same of a surface that joints move, as `skinned`.
[[nodiscard]] Eigen::Vector3d skinned_normal(const Eigen::Vector3d& normal, std::span<const Influence> influences,
                                             const std::vector<Eigen::Matrix4d>& joint_matrices);

/// The point as the matrix moves it. The matrix is affine.
[[nodiscard]] inline Eigen::Vector3d transformed(const Eigen::Vector3d& point, const Eigen::Matrix4d& matrix) {
    return matrix.topLeftCorner<3, 3>() * point + matrix.topRightCorner<3, 1>();
}

} // namespace skelgen::io::detail
