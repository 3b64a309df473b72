#pragma once

#include <optional>
#include <vector>

#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/core/skeleton_template.hpp>

namespace skelgen::symmetry {

/// How a mesh mirrors itself, vertex by vertex.
template <typename Scalar = double>
struct ExactMirror {
    Vector3<Scalar> normal = Vector3<Scalar>::UnitX(); ///< of the plane, unit, either way
    Scalar offset = 0;                                 ///< of the plane along it
    std::vector<int> partner;                          ///< per vertex one at its mirror image; -1: no face uses it

    [[nodiscard]] Vector3<Scalar> operator()(const Vector3<Scalar>& place) const {
        return place - 2 * (normal.dot(place) - offset) * normal;
    }
};

/// How far places of an exactly mirrored mesh may be from where they belong: as part of the mesh's bounding diagonal.
inline constexpr double mirror_tolerance = 1e-5;

/// The plane in which a mesh mirrors itself, each vertex to another one's place within `mirror_tolerance`; none where
/// there is no such plane. The places of such a mesh have it among the planes of their principal axes. O(n log n).
template <typename Scalar>
[[nodiscard]] std::optional<ExactMirror<Scalar>> exact_mirror(const TriangleMesh<Scalar>& mesh);

/// Does a skeleton mirror itself with its mesh, left to right, each joint within `tolerance` (in its unit)?
/// \throws Error usage when the skeleton is not of that template.
template <typename Scalar>
[[nodiscard]] bool is_mirrored(const KinematicSkeleton<Scalar>& skeleton, const SkeletonTemplate& skeleton_template,
                               const ExactMirror<Scalar>& mirror, Scalar tolerance);

/// The skeleton of an exactly mirrored mesh with each joint in the middle between where it and its counterpart's
/// mirror image were, those without a side in the plane: so are radii, confidences, end points and the frame. One that
/// was found on one side alone is there on both. A skeleton that does not nearly mirror itself, or in another plane
/// than that between left and right, comes back as it is. `size`: of the mesh. \throws Error as `is_mirrored`.
template <typename Scalar>
[[nodiscard]] KinematicSkeleton<Scalar> mirrored_evenly(KinematicSkeleton<Scalar> skeleton,
                                                        const SkeletonTemplate& skeleton_template,
                                                        const ExactMirror<Scalar>& mirror, Scalar size);

} // namespace skelgen::symmetry

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/symmetry/impl/exact_mirror.hpp>
#endif
