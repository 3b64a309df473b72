#pragma once

#include <vector>

#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/core/skeleton_template.hpp>

namespace skelgen::anatomy {

/// A joint that is doubted more looks misplaced: calibrated, seven in ten of those above are wrong.
inline constexpr double misplaced_from = 9;

/// Per joint the doubt about the worst of its bones, from its parent and to its children within a limb or within the
/// trunk: where a limb leaves the trunk, its first bone says nothing of the trunk's joint. 0 where bones are as long as
/// those of the other side and as the template's at the skeleton's own scale; about 1 where they differ by a sixth from
/// the other side's, or by a third from the template's; short bones count for less. The two sides are compared by the
/// lengths `measured` before they were made alike (per joint that of the bone from its parent): making them alike is no
/// evidence. `skeleton` is in template order. O(joints^2).
template <typename Scalar>
[[nodiscard]] std::vector<double> joint_doubts(const KinematicSkeleton<Scalar>& skeleton,
                                               const SkeletonTemplate& skeleton_template,
                                               const std::vector<Scalar>& measured);

} // namespace skelgen::anatomy

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/anatomy/impl/confidence.hpp>
#endif
