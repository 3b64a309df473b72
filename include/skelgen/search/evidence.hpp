#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include <skelgen/anatomy/complete.hpp>
#include <skelgen/core/curve_skeleton.hpp>
#include <skelgen/core/evidence.hpp>
#include <skelgen/core/skeleton_template.hpp>
#include <skelgen/embedding/embed.hpp>
#include <skelgen/surface/body.hpp>

namespace skelgen::search {

/// What speaks for or against a skeleton: numbers without a verdict (trust.hpp gives that). Most are logarithms or
/// shares, so that each may be weighed by one factor.
enum class Witness {
    // how it was found
    unmatched_reach, ///< how far the curve goes on beyond the template's limbs in it
    fitted,          ///< 1 where a body was laid into the surface, not a template into a curve
    posed,           ///< 1 where that may be in any pose, 0 for one at rest or none
    fit_cost,        ///< log of what the surface costs that this does not explain
    envelope,        ///< 1 where an envelope stands for the pieces
    lacks_head,      ///< 1 where the template lacks a head
    lacks_limbs,     ///< how many limbs it lacks
    cut_limbs,       ///< how many limbs' ends the surface shows to be cut off
    // surface and joints
    reach,        ///< log of the largest geodesic distance over the square root of the area, relative to an adult's
    doubt,        ///< mean over the joints of log(1 + doubt): see anatomy::joint_doubts
    outside,      ///< share of the joints that were outside the surface
    apart,        ///< how deep, in its radius, the worst joint of a limb lies in another limb or the trunk
    folded,       ///< how near, from 0 to 1, the worst wrist or ankle is to its own upper bone
    unexplained,  ///< share of the surface that lies far beyond all bones
    pairs_girths, ///< mean |log ratio| of the distances of left and right bones to the surface
    // proportions, as log ratios to the trunk, relative to an adult's
    arm_length,
    leg_length,
    hip_width,
    below_hips,  ///< log of how far the surface is below the hips, relative to an adult's legs
    neck_height, ///< how far the neck is above the shoulders, in trunks
    // pose and sides
    sides,      ///< how far the witnesses of the sides agree, from 0 to 1
    legs_go_on, ///< smaller cosine of the trunk's direction, downwards, and a leg's
    // beside the other candidates
    others_lack, ///< how many limbs more than it those lack, in the mean, that were found in curves
    agreed,      ///< how far they agree with it: mean of agreement(), as if `dissenters` more did not
    heard,       ///< share of the others in these: n / (n + dissenters) for n others
    count
};

inline constexpr std::size_t witness_count = static_cast<std::size_t>(Witness::count);

/// Of one candidate.
using Evidence = core::EvidenceOf<Witness>;

/// Proportions that are unlikely where they are far off an adult's either way.
inline constexpr std::array curved_witnesses{Witness::arm_length, Witness::leg_length,  Witness::hip_width,
                                             Witness::below_hips, Witness::neck_height, Witness::reach};

/// As `./dev calibrate` spells it: "arm_length".
[[nodiscard]] std::string_view to_string(Witness witness);

/// What a skeleton, its body and its curve show by themselves; how it was found, and how far others agree, is added by
/// the search.
/// `embedding`: of the template `wanted` in the curve; null where none was laid into it. `diameter` the largest
/// geodesic distance on the body. O(n) and some hundred questions to the body's tree.
template <typename Scalar>
[[nodiscard]] Evidence
evidence_of(const Body<Scalar>& body, const CurveSkeleton<Scalar>& curve, const embedding::Embedding* embedding,
            const anatomy::CompletedSkeleton<Scalar>& completed, const SkeletonTemplate& wanted, Scalar diameter);

} // namespace skelgen::search

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/search/impl/evidence.hpp>
#endif
