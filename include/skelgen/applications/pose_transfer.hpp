#pragma once

#include <skelgen/applications/floor.hpp>
#include <skelgen/applications/skinning.hpp>
#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/core/skeleton_template.hpp>
#include <skelgen/surface/body.hpp>

namespace skelgen::applications {

/// A body in another pose than it was found in.
template <typename Scalar = double>
struct PosedBody {
    TriangleMesh<Scalar> mesh;          ///< the input's vertices and faces in their order, faces as `outward_faces`
    KinematicSkeleton<Scalar> skeleton; ///< where its joints went; bones have kept their lengths
    VertexTurns<Scalar> turns = {};     ///< from the input's pose to this one
};

/// Holds a body as a model holds itself, whatever the shape, proportions and unit of both. Each bone is turned as the
/// model's, in the model's coordinates. The joints come as near to the model's as the geometric median of their ways
/// there brings them: each of them, the root too, may have been found off. The mesh follows by dual quaternions
/// (`skinned`), so that limbs keep their volume. Both skeletons are of the same template, each in its own coordinates;
/// `mesh` and `body` as `bind` has them. \throws Error as that.
template <typename Scalar>
[[nodiscard]] PosedBody<Scalar>
pose_like(const TriangleMesh<Scalar>& mesh, const Body<Scalar>& body, const KinematicSkeleton<Scalar>& skeleton,
          const KinematicSkeleton<Scalar>& model, const SkeletonTemplate& skeleton_template);

/// The posed body moved along the floor's `up` to where its lowest place is on the floor. O(n).
template <typename Scalar>
[[nodiscard]] PosedBody<Scalar> put_on(PosedBody<Scalar> body, const Floor<Scalar>& floor);

} // namespace skelgen::applications

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/applications/impl/pose_transfer.hpp>
#endif
