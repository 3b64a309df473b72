#pragma once

#include <skelgen/core/skeleton_template.hpp>
#include <skelgen/refinement/limbs.hpp>

namespace skelgen {

/// How far a limb's own proportions may be from the template's (standard deviations of logarithms of lengths), and how
/// closely its thickness follows that of other people.
struct ThicknessProfileOptions {
    double end_deviation = 0.2;         ///< of hand or foot: fists and shoes change it much
    double limb_deviation = 0.2;        ///< of the middle joint's distance from the tip
    double bone_deviation = 0.1;        ///< of forearm or calf
    double proportion_deviation = 0.08; ///< of upper bone against lower bone
    double thickness_deviation = 0.07;  ///< of the logarithm of thickness
    double independent_samples = 10;    ///< as many independent measurements a limb's thickness profile is worth
};

/// Moves the joints of arms and legs along their centrelines to where their thickness says they are: everybody's
/// forearm and calf swell and thin in the same places relative to wrist and elbow, ankle and knee, whatever the
/// proportions. Finds for each limb the piecewise linear stretch of the mean profile that fits its own best, for any
/// stoutness. Upper bones are as long as the lower ones of both sides make them likely, and, where the trunk tells
/// their upper ends, as these do. Only `from_tip` changes, and `attachment` where a limb is hidden, of limbs with
/// joints of those roles. \returns how many times longer than the template's the lower bones are, on average (1 when
/// there are none). O(samples) for each of some hundred stretches per limb.
double match_thickness_profiles(std::vector<Limb>& limbs, const SkeletonTemplate& skeleton_template,
                                const ThicknessProfileOptions& options = {});

} // namespace skelgen
