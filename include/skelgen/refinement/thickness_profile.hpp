#pragma once

#include <vector>

#include <skelgen/core/skeleton_template.hpp>
#include <skelgen/refinement/bend.hpp>
#include <skelgen/refinement/bone_line.hpp>
#include <skelgen/refinement/centreline.hpp>
#include <skelgen/refinement/cross_section.hpp>
#include <skelgen/refinement/end_points.hpp>
#include <skelgen/refinement/limbs.hpp>
#include <skelgen/refinement/profile_matcher.hpp>

namespace skelgen::refinement {

/// Limbs whose joints lie where their thickness says.
template <typename Scalar = double>
struct ThicknessMatch {
    std::vector<Limb<Scalar>> limbs;
    Scalar ratio = 1; ///< how many times longer than the template's the lower bones are, on average; 1 without any
};

/// Moves the joints of arms and legs along their centrelines to where their thickness says they are: everybody's
/// forearm and calf swell and thin in the same places relative to wrist and elbow, ankle and knee, whatever the
/// proportions. Finds for each limb the piecewise linear stretch of the mean profile that fits its own best, for any
/// stoutness; a bent limb is compared as if it were straight, without its fold. Legs go first, and tell how long arms
/// are likely to be. Upper bones are as long as the lower ones of both sides make them likely, and, where the trunk
/// tells their upper ends, as these do. Only `from_tip` changes, and `attachment` where a limb is hidden, of limbs with
/// joints of those roles. O(samples) for each of some hundred stretches per limb.
template <typename Scalar>
[[nodiscard]] ThicknessMatch<Scalar>
match_thickness_profiles(std::vector<Limb<Scalar>> limbs, const SkeletonTemplate& skeleton_template,
                         const ThicknessProfileOptions& options = {}, const BendOptions& bend = {},
                         const BoneLineOptions& bone_line = {});

/// The limbs with those that end at wrist or ankle, a hand or a foot being cut off, drawn as such: their thickness goes
/// on as a forearm's or a calf's to the end, and less like a whole limb's. What lies beyond counts as `missing`.
/// `ends` are the limbs' in the same order. O(sections (n + m)) for each of these.
template <typename Scalar>
[[nodiscard]] std::vector<Limb<Scalar>>
shorten_cut_limbs(std::vector<Limb<Scalar>> limbs, const Slicer<Scalar>& slicer,
                  const std::vector<EndPoint<Scalar>>& ends, const SkeletonTemplate& skeleton_template,
                  const ThicknessProfileOptions& options = {}, const CentrelineOptions& centreline = {});

} // namespace skelgen::refinement

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/refinement/impl/thickness_profile.hpp>
#endif
