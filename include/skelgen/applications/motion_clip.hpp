#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <skelgen/core/mesh.hpp>

namespace skelgen::applications {

/// What one number of a frame says of a joint.
enum class ClipChannel { x_position, y_position, z_position, x_rotation, y_rotation, z_rotation };

/// A joint of a skeleton whose motion was recorded.
struct ClipJoint {
    std::string name;
    int parent = -1;                                  ///< index into the joints, smaller than the joint's own
    Vector3<double> offset = Vector3<double>::Zero(); ///< from the parent at rest, any unit
    /// In the order of their numbers in a frame. Positions stand for the offset's coordinates; rotations, in degrees,
    /// are multiplied in this order.
    std::vector<ClipChannel> channels = {};
    std::optional<Vector3<double>> end =
        std::nullopt; ///< of the bone of a joint without children, from the joint at rest
};

/// A skeleton and how it moved, as a BVH file has it. Clips are read from files: they are double whatever the scalar of
/// the mesh.
struct MotionClip {
    std::vector<ClipJoint> joints; ///< parents before children; the first is the root
    /// A row per frame with a column per channel, the joints' in their order.
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> frames;
    double seconds_per_frame = 1.0 / 30;
};

/// Where the joints of a clip are, and how they have turned since they were at rest: one entry per joint.
struct ClipPose {
    std::vector<Eigen::Quaterniond> turns;
    std::vector<Vector3<double>> positions;
};

/// \throws Error usage when a clip's joint has a parent that is not before it, or the rows of its frames have not as
/// many numbers as its joints have channels. O(joints).
void validate(const MotionClip& clip);

/// The clip's skeleton with all channels zero but positions, for which the offsets stand. O(joints). \throws Error as
/// `validate`.
[[nodiscard]] ClipPose rest_pose(const MotionClip& clip);

/// The clip's skeleton in a frame, counted from 0. O(joints). \throws Error usage when there is no such frame, or as
/// `validate`.
[[nodiscard]] ClipPose pose_in(const MotionClip& clip, std::size_t frame);

} // namespace skelgen::applications

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/applications/impl/motion_clip.hpp>
#endif
