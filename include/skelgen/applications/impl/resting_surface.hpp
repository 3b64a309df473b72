#pragma once

#include <vector>

#include <skelgen/applications/bone_orientations.hpp>
#include <skelgen/applications/canonical_frame.hpp>
#include <skelgen/applications/impl/heat_weights.hpp>
#include <skelgen/applications/skinning.hpp>
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
Points<Scalar> at_rest(const RestingSurface<Scalar>& surface, const JointWeights& weights,
                       const std::vector<int>& rows) {
    const JointWeights own = weights(rows, Eigen::all);
    return skinned<Scalar>(surface.as_is(rows, Eigen::all), strongest_influences<Scalar>(own.cast<Scalar>()),
                           surface.motions);
}

/// The same for all vertices.
template <typename Scalar>
Points<Scalar> at_rest(const RestingSurface<Scalar>& surface, const JointWeights& weights) {
    return skinned<Scalar>(surface.as_is, strongest_influences<Scalar>(weights.cast<Scalar>()), surface.motions);
}

} // namespace skelgen::applications
