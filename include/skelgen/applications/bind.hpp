#pragma once

#include <vector>

#include <skelgen/applications/posing.hpp>
#include <skelgen/applications/skinning.hpp>
#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/core/skeleton_template.hpp>
#include <skelgen/surface/body.hpp>

namespace skelgen::applications {

/// What stands for each vertex of an input on a body's surface: a place in one of its faces.
template <typename Scalar = double>
struct SurfacePlace {
    int face = -1;
    Vector3<Scalar> share = Vector3<Scalar>::Zero(); ///< of each of the face's corners; they sum to 1
    Scalar distance = 0;                             ///< from the vertex, in the body's coordinates
};

/// The place on the body that stands for each vertex of the mesh that it was made of: the nearest one on the faces
/// around the vertex that stands for it (`standing_for`). \throws Error as that. O(n log n).
template <typename Scalar>
[[nodiscard]] std::vector<SurfacePlace<Scalar>> places_on(const Body<Scalar>& body, const TriangleMesh<Scalar>& mesh);

/// A pose that a body is bent from.
template <typename Scalar = double>
struct StartOfBends {
    std::vector<RigidMotion<Scalar>> motions; ///< what brings each joint to it
    Orientations<Scalar> axes;                ///< of each joint in it, as `bone_axes` has them
};

/// Binds a mesh to its skeleton: heat weights on the closed surface around all of its pieces, as it is and at rest
/// alike, carried over to each vertex from the place that stands for it, so that pieces move with what they lie on and
/// seams stay closed, and no edge of the mesh stretches too far (`with_bounded_stretch`). Where mesh and skeleton
/// mirror themselves, weights do. `skeleton` in the mesh's coordinates, `body` made of that mesh (`extract`), `start`
/// the pose that edges count from; an empty one: the T-pose. \throws Error no_skeleton where the skeleton does not lie
/// in the body; usage when it is not of that template, `start` has not as many joints, or the body was made of another
/// mesh.
template <typename Scalar>
[[nodiscard]] Skin<Scalar> bind(const TriangleMesh<Scalar>& mesh, const Body<Scalar>& body,
                                const KinematicSkeleton<Scalar>& skeleton, const SkeletonTemplate& skeleton_template,
                                StartOfBends<Scalar> start = {});

} // namespace skelgen::applications

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/applications/impl/bind.hpp>
#endif
