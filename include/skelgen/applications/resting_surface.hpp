#pragma once

#include <vector>

#include <skelgen/applications/bone_orientations.hpp>
#include <skelgen/applications/canonical_frame.hpp>
#include <skelgen/applications/heat_weights.hpp>
#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/core/mesh.hpp>

namespace skelgen::applications {

/// A surface that comes to rest as its weights have it.
template <typename Scalar = double>
struct RestingSurface {
    const Points<Scalar>& as_is;                     ///< where its vertices are
    const std::vector<RigidMotion<Scalar>>& motions; ///< per joint, to rest
    const KinematicSkeleton<Scalar>& skeleton;       ///< at rest
    const Orientations<Scalar>& axes;                ///< per joint at rest: elbows and knees bend about x, forwards
};

/// Where the vertices named by `rows` are at rest, in their order: `skinned` by their four strongest joints.
/// `weights` of all of the surface's vertices. O(rows joints).
template <typename Scalar>
[[nodiscard]] Points<Scalar> at_rest(const RestingSurface<Scalar>& surface, const JointWeights& weights,
                                     const std::vector<int>& rows);

/// The same for all vertices.
template <typename Scalar>
[[nodiscard]] Points<Scalar> at_rest(const RestingSurface<Scalar>& surface, const JointWeights& weights);

} // namespace skelgen::applications

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/applications/impl/resting_surface.hpp>
#endif
