#pragma once

#include <vector>

#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/core/skeleton_template.hpp>
#include <skelgen/surface/body.hpp>

namespace skelgen::applications {

/// Where a plane across a bone cuts the body around it.
template <typename Scalar = double>
struct BoneSection {
    int joint = -1;                      ///< whose bone it is
    std::vector<Vector3<Scalar>> points; ///< in order around the bone, closed from the last to the first
};

/// Sections across each joint's own bone (`bone_end`), `per_bone` of them, evenly spaced: in the order of the joints,
/// and along the bone. `skeleton` and result in the input's coordinates. A bone that has no length, or nothing around
/// it, has none there. \throws Error usage when `per_bone` is not from 1 to 100, or the skeleton's joints are not the
/// template's. O(log n) for each face that is cut.
template <typename Scalar>
[[nodiscard]] std::vector<BoneSection<Scalar>>
bone_sections(const Body<Scalar>& body, const KinematicSkeleton<Scalar>& skeleton,
              const SkeletonTemplate& skeleton_template, int per_bone = 4);

} // namespace skelgen::applications

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/applications/impl/bone_sections.hpp>
#endif
