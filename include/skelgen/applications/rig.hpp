#pragma once

#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <skelgen/applications/posing.hpp>
#include <skelgen/applications/skinning.hpp>
#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/core/skeleton_template.hpp>
#include <skelgen/surface/body.hpp>

namespace skelgen::applications {

/// A joint of a rig in its rest pose.
template <typename Scalar = double>
struct RigJoint {
    std::string name;
    int parent = -1; ///< index into the joints, smaller than the joint's own; -1 for the root
    JointRole role = JointRole::pelvis;
    Side side = Side::none;
    Vector3<Scalar> position = Vector3<Scalar>::Zero();
    Vector3<Scalar> end = Vector3<Scalar>::Zero(); ///< of its bone: the next joint, or the limb's end on the surface
    /// From x, y and z to the joint's axes: y along the bone, x about which it bends; mirrored from side to side.
    Eigen::Quaternion<Scalar> axes = Eigen::Quaternion<Scalar>::Identity();
    double confidence = 1; ///< as the skeleton's joint has it
    /// How the joint is turned from the template's rest pose (`bone_orientations`).
    Eigen::Quaternion<Scalar> orientation = Eigen::Quaternion<Scalar>::Identity();
};

/// Where a rig is put.
enum class Place {
    keep,   ///< where the input was, in its scene, on the same floor; as `centre` where it had to be turned
    centre, ///< the lowest place on y = 0, the root above the origin
    floor,  ///< the lowest place on y = 0, but moved up or down alone; as `centre` where it had to be turned
};

/// What is to be made of a body.
struct RigOptions {
    RestPose rest = RestPose::as_is;
    Place place = Place::centre;
    double metres_per_unit = 0; ///< of the input; 0: as the body's height tells
};

/// A mesh bound to joints, in its rest pose: +y up, facing +z. An input that stands so within 20 degrees, or with other
/// axes of its coordinates up and ahead, is turned by these axes alone. It stays as level as it was.
template <typename Scalar = double>
struct Rig {
    TriangleMesh<Scalar> mesh;            ///< the input's vertices and faces in their order, faces as `outward_faces`
    std::vector<RigJoint<Scalar>> joints; ///< in the template's order, parents before children
    Skin<Scalar> skin;
    /// From the input's pose to the rest pose: what the input's normals are turned by. Empty: not known.
    VertexTurns<Scalar> turns = {};
    /// What each joint of the skeleton has done to the input's points, times `metres_per_unit`, that are fixed to it.
    std::vector<RigidMotion<Scalar>> motions = {};
    RestPose rest = RestPose::as_is;
    Scalar metres_per_unit = 1; ///< what the input's coordinates were multiplied by
    bool unit_is_known = false; ///< else they keep the input's unit
};

/// A person's height, standing, as the skeleton has it: from the lower ankle's end to the top of the head along the
/// bones. In the skeleton's unit. \throws Error usage when the skeleton's joints are not the template's.
template <typename Scalar>
[[nodiscard]] Scalar height_by_bones(const KinematicSkeleton<Scalar>& skeleton,
                                     const SkeletonTemplate& skeleton_template);

/// Metres in the unit in which someone has this height: 1, 0.01 or 0.001. People of 0.5 to 2.5 m have it then in
/// metres, centimetres or millimetres. 0: not known.
[[nodiscard]] double metres_per_unit(double height);

/// From a body to a character: binds the mesh to its skeleton (`bind`), puts it into the rest pose, and gives joints
/// their axes. \throws Error as `bind`.
template <typename Scalar>
[[nodiscard]] Rig<Scalar> make_rig(const TriangleMesh<Scalar>& mesh, const Body<Scalar>& body,
                                   const KinematicSkeleton<Scalar>& skeleton, const SkeletonTemplate& skeleton_template,
                                   const RigOptions& options);

/// The same on y = 0 with the root above the origin, in the unit that the height tells.
template <typename Scalar>
[[nodiscard]] Rig<Scalar> make_rig(const TriangleMesh<Scalar>& mesh, const Body<Scalar>& body,
                                   const KinematicSkeleton<Scalar>& skeleton, const SkeletonTemplate& skeleton_template,
                                   RestPose rest = RestPose::as_is) {
    return make_rig(mesh, body, skeleton, skeleton_template, RigOptions{rest});
}

} // namespace skelgen::applications

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/applications/impl/rig.hpp>
#endif
