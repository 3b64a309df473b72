#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include <skelgen/anatomy/complete.hpp>
#include <skelgen/core/boosted_trees.hpp>
#include <skelgen/core/curve_skeleton.hpp>
#include <skelgen/core/skeleton_template.hpp>
#include <skelgen/embedding/embed.hpp>
#include <skelgen/surface/body.hpp>

namespace skelgen::search {

/// What speaks for or against a skeleton: numbers without a verdict (trust.hpp gives that). Most are logarithms or
/// shares, so that each may be weighed by one factor.
enum class Witness {
    // the template in the curve
    distortion,      ///< log of the distortion per pair, relative to what fits well
    unmatched,       ///< of the curve's length what belongs to no limb, relative to the limbs'
    unmatched_reach, ///< how far that goes on beyond the limbs
    clutter_head,    ///< of what belongs to no limb the part that hangs at the head: hair, hats, horns
    clutter_hands,   ///< in the hands: what is held
    clutter_back,    ///< at the trunk above its middle: cloaks, wings
    clutter_legs,    ///< at the trunk's lower half and the legs: tails, skirts
    contacts,        ///< loops that the curve has
    fitted,          ///< 1 where a body at rest was laid into the surface, not a template into a curve
    fit_cost,        ///< log of what the surface costs that this does not explain
    adapted,         ///< 1 where the template's proportions had to be changed
    lacks_head,      ///< 1 where the template lacks a head
    lacks_limbs,     ///< how many limbs it lacks
    cut_limbs,       ///< how many limbs' ends the surface shows to be cut off
    // the surface
    reach,    ///< log of the largest geodesic distance over the square root of the area, relative to an adult's
    envelope, ///< 1 where an envelope stands for the pieces
    rounded,  ///< 1 where a coarse surface was made rounder
    left_out, ///< share of the input's area that is not on the surface
    noisy,    ///< 1 where much noise was smoothed away
    opened,   ///< 1 where it was opened or its pockets were closed
    cut,      ///< 1 where it was cut at loops of its curve
    held,     ///< 1 where what the hands hold was taken off
    // the joints
    doubt,         ///< mean over the joints of log(1 + doubt): see anatomy::joint_doubts
    misplaced,     ///< share of the joints that look misplaced
    outside,       ///< share of the joints that were outside the surface
    apart,         ///< how deep, in its radius, the worst joint of a limb lies in another limb or the trunk
    unexplained,   ///< share of the surface that lies far beyond all bones
    support,       ///< share of the bones' places that lie inside
    slack,         ///< mean over limbs of the log of how far the surface is beyond what the bone's length lets expect
    pairs_lengths, ///< mean |log ratio| of left and right bones, as measured
    pairs_girths,  ///< mean |log ratio| of the distances of left and right bones to the surface
    mirror,        ///< share of the surface that mirrors itself in the sagittal plane
    // proportions, as log ratios to the trunk, relative to an adult's
    head_size,
    arm_length,
    leg_length,
    shoulder_width,
    hip_width,
    trunk_girth,
    below_hips,  ///< log of how far the surface is below the hips, relative to an adult's legs
    neck_height, ///< how far the neck is above the shoulders, in trunks
    // pose and sides
    sides,       ///< how far the witnesses of the sides agree, from 0 to 1
    legs_go_on,  ///< smaller cosine of the trunk's direction, downwards, and a leg's
    four_legged, ///< 1 where arms and legs point alike, across the trunk
    // which body was laid into the surface
    posed, ///< 1 for one in any pose, 0 for one at rest or none
    count
};

inline constexpr std::size_t witness_count = static_cast<std::size_t>(Witness::count);

/// Of one candidate.
using Evidence = core::EvidenceOf<Witness>;

/// Proportions that are unlikely where they are far off an adult's either way.
inline constexpr std::array curved_witnesses{
    Witness::head_size,   Witness::arm_length, Witness::leg_length,  Witness::shoulder_width, Witness::hip_width,
    Witness::trunk_girth, Witness::below_hips, Witness::neck_height, Witness::reach,          Witness::slack};

/// As `./dev calibrate` spells it: "clutter_head".
[[nodiscard]] std::string_view to_string(Witness witness);

/// What a skeleton, its body and its curve show by themselves; what was done to the surface is added by the search.
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
