#pragma once

#include <string>
#include <vector>

#include <skelgen/applications/bone_orientations.hpp>
#include <skelgen/applications/canonical_frame.hpp>
#include <skelgen/applications/rig.hpp>
#include <skelgen/core/mesh.hpp>

namespace skelgen::applications {

/// A rig in another pose than at rest.
template <typename Scalar = double>
struct RigPose {
    Vector3<Scalar> root = Vector3<Scalar>::Zero(); ///< where the root joint is
    Orientations<Scalar> axes;                      ///< of each joint, as `RigJoint::axes`
    Scalar lift = 0; ///< how much higher than at rest the hips are, where the root joint carries them from the floor
};

/// How a rig moves: poses that follow each other in even steps of time.
template <typename Scalar = double>
struct Animation {
    std::string name;
    double seconds_per_frame = 1.0 / 30;
    std::vector<RigPose<Scalar>> frames;
};

/// What each joint does to what is fixed to it, from the rest pose to this one: forward kinematics. O(joints). \throws
/// Error usage when the pose has not as many axes as there are joints.
template <typename Scalar>
[[nodiscard]] std::vector<RigidMotion<Scalar>> motions(const std::vector<RigJoint<Scalar>>& joints,
                                                       const RigPose<Scalar>& pose);

/// The rig's mesh in a pose, by dual quaternions (`skinned`). O(n). \throws Error as `motions`.
template <typename Scalar>
[[nodiscard]] TriangleMesh<Scalar> posed(const Rig<Scalar>& rig, const RigPose<Scalar>& pose);

/// Moves an animation up or down so that its lowest frames are on the floor, y = 0. Of each frame the lowest place of
/// the mesh counts; a twentieth of the frames lies below the height that is taken. So neither a jump nor a single odd
/// frame, as the T-pose that many clips begin with, lifts or sinks the rest. The height of a frame is looked for among
/// those vertices of each joint that lie farthest out in 26 directions. O(n + frames joints).
template <typename Scalar>
[[nodiscard]] Animation<Scalar> on_floor(const Rig<Scalar>& rig, Animation<Scalar> animation);

} // namespace skelgen::applications

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/applications/impl/animation.hpp>
#endif
