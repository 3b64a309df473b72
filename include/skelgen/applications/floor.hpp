#pragma once

#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/core/skeleton_template.hpp>

namespace skelgen::applications {

/// Where a model stands on a floor, and which way is up.
template <typename Scalar = double>
struct Floor {
    Vector3<Scalar> up =
        Vector3<Scalar>::UnitY(); ///< the axis of the coordinates, or its opposite, nearest to the body's
    Scalar height = 0;            ///< of the lowest place of its surface along `up`
    bool is_stood_on = false;     ///< a foot, or both, are down there
};

/// Looks whether a body stands, be it on one leg: its lowest place is no farther below a foot's joint and toe than a
/// tenth of the body's height. \throws Error usage when the skeleton's joints are not the template's. O(faces).
template <typename Scalar>
[[nodiscard]] Floor<Scalar> floor_of(const TriangleMesh<Scalar>& mesh, const KinematicSkeleton<Scalar>& skeleton,
                                     const SkeletonTemplate& skeleton_template);

/// Which way is up for a body as it is held. Where its soles lie flat on a floor, a plane across an axis of its
/// coordinates, that axis: trunks lean, as people do who walk or bend. Else up along the trunk, as its frame has it.
/// \throws Error usage when the skeleton's joints are not the template's. O(faces).
template <typename Scalar>
[[nodiscard]] Vector3<Scalar> upright(const TriangleMesh<Scalar>& mesh, const KinematicSkeleton<Scalar>& skeleton,
                                      const SkeletonTemplate& skeleton_template);

} // namespace skelgen::applications

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/applications/impl/floor.hpp>
#endif
