#pragma once

#include <optional>
#include <vector>

#include <skelgen/core/mesh.hpp>
#include <skelgen/core/skeleton_template.hpp>
#include <skelgen/refinement/bone_line.hpp>
#include <skelgen/refinement/limbs.hpp>

namespace skelgen::refinement {

/// Median thickness of an upper arm's own sections, between elbow and armpit; none with fewer than three of them. The
/// limb must have two joints. O(sections).
template <typename Scalar>
[[nodiscard]] std::optional<Scalar> upper_arm_thickness(const Limb<Scalar>& limb);

/// The limbs with `top_by_trunk` and `top_deviation` of the arms set: an upper arm is as thick all along, and grows
/// where the armpit begins, a third of its length before the shoulder; raised, the skin goes along, and it begins
/// nearer. `trunk_up`: from the fork of the legs to the head, a unit vector; without it arms count as held level. Left
/// unset where an arm shows too little of its own, or does not grow. O(sections).
template <typename Scalar>
[[nodiscard]] std::vector<Limb<Scalar>>
anchor_shoulders(std::vector<Limb<Scalar>> limbs, const std::optional<Vector3<Scalar>>& trunk_up,
                 const SkeletonTemplate& skeleton_template, const BoneLineOptions& options = {});

} // namespace skelgen::refinement

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/refinement/impl/shoulder_anchor.hpp>
#endif
