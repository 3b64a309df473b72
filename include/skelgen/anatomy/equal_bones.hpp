#pragma once

#include <vector>

#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/core/skeleton_template.hpp>

namespace skelgen::anatomy {

/// Per joint the length of the bone from its parent; 0 for the root. O(joints).
template <typename Scalar>
[[nodiscard]] std::vector<Scalar> bone_lengths(const KinematicSkeleton<Scalar>& skeleton);

/// A skeleton with like bones on both sides, and what it was made of.
template <typename Scalar = double>
struct EqualBones {
    KinematicSkeleton<Scalar> skeleton;
    std::vector<Scalar> measured; ///< bone_lengths() as they were before
};

/// The skeleton with the bones of both sides brought to like lengths, as they are in people: where a bone of a limb and
/// its counterpart differ by more than 4 % (and less than a third), their joints move along them, as little as that
/// takes (position-based dynamics, MHHR07). `skeleton` is in template order. O(joints^2).
template <typename Scalar>
[[nodiscard]] EqualBones<Scalar> equalise_bones(KinematicSkeleton<Scalar> skeleton,
                                                const SkeletonTemplate& skeleton_template);

} // namespace skelgen::anatomy

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/anatomy/impl/equal_bones.hpp>
#endif
