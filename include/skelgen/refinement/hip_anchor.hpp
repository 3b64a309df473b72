#pragma once

#include <vector>

#include <skelgen/core/mesh.hpp>
#include <skelgen/core/skeleton_template.hpp>
#include <skelgen/refinement/bone_line.hpp>
#include <skelgen/refinement/limbs.hpp>
#include <skelgen/refinement/trunk_axis.hpp>

namespace skelgen::refinement {

/// The limbs with `top_by_trunk` and `top_deviation` of the two legs set: the pelvis is one bone, and its hips lie at
/// the same height above where the legs part in everybody, however the legs are held. `axis`: the lower trunk's;
/// `scale`: rest-pose length to body length. Left unset where there are no two legs, or a leg shows too little of its
/// thigh. O(limbs).
template <typename Scalar>
[[nodiscard]] std::vector<Limb<Scalar>> anchor_hips(std::vector<Limb<Scalar>> limbs, const TrunkAxis<Scalar>& axis,
                                                    const SkeletonTemplate& skeleton_template, Scalar scale,
                                                    const BoneLineOptions& options = {});

} // namespace skelgen::refinement

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/refinement/impl/hip_anchor.hpp>
#endif
