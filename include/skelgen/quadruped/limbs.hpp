#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

#include <skelgen/core/curve_skeleton.hpp>
#include <skelgen/core/evidence.hpp>
#include <skelgen/core/kinematic_skeleton.hpp>

/// Four-legged animals: another plan than people's, found in the same curves.
namespace skelgen::quadruped {

/// What speaks for or against a way to see an animal in a curve: numbers without a verdict. Lengths are relative to the
/// sum of the trunk's and a mean leg's, unless they are logarithms of ratios; directions are cosines.
enum class Witness {
    // along the curve
    fore_lengths,   ///< |log ratio| of the fore legs' lengths
    hind_lengths,   ///< of the hind legs'
    fore_to_hind,   ///< log ratio of fore legs to hind legs
    fore_apart,     ///< how far from each other the fore legs leave the trunk
    trunk_length,   ///< length from hind legs to fore legs
    neck_length,    ///< from the fore legs to the head's end
    tail_length,    ///< 0 where there is none
    tail_apart,     ///< how far before the hind legs the tail leaves the trunk
    lacks_tail,     ///< 1 where there is none
    unmatched,      ///< longest branch that belongs to no part, but for those at the head
    unmatched_many, ///< how many such branches are longer than a tenth
    unmatched_head, ///< longest branch at the head: horns, ears
    end_count,      ///< of the curve
    // thickness
    fore_ends,    ///< |log ratio| of the fore feet's
    hind_ends,    ///< of the hind feet's
    head_to_feet, ///< log ratio of the head's end to the feet
    fore_to_hind_ends,
    tail_to_head, ///< log ratio of the tail's end to the head's, 0 where there is none
    trunk_girth,  ///< log of the trunk's mean radius
    leg_girth,    ///< log ratio of the legs' lower parts to the trunk
    neck_girth,   ///< log ratio of the neck to the trunk
    // directions
    fore_parallel,  ///< of one fore leg with the other
    hind_parallel,  ///< of one hind leg with the other
    legs_parallel,  ///< of the fore legs with the hind legs
    legs_along,     ///< mean |cosine| of a leg with the trunk
    legs_down,      ///< mean of the legs with the common direction that they have across the trunk
    least_down,     ///< of the leg that has it least
    legs_straight,  ///< mean ratio of a leg's straight length to that along it
    trunk_straight, ///< the same of the trunk
    head_forward,
    head_up,
    tail_back,
    tail_up,
    fore_width, ///< from one fore leg to the other, sideways
    hind_width,
    // how legs bend: how far forward of their straight line they lie
    fore_lower_bend,
    fore_middle_bend,
    fore_upper_bend,
    hind_lower_bend,
    hind_middle_bend,
    hind_upper_bend,
    toes, ///< how far the feet's ends point forward
    count
};

inline constexpr std::size_t witness_count = static_cast<std::size_t>(Witness::count);

/// As `./dev calibrate` spells it: "fore_lengths".
[[nodiscard]] std::string_view to_string(Witness witness);

/// Of one way to see an animal in a curve.
using Evidence = core::EvidenceOf<Witness>;

/// The probability that an animal's feet, head, tail and sides are where a way to see it has them. Its log odds are
/// linear in the evidence, plus small trees boosted on that (search/trust.hpp does the same for people).
[[nodiscard]] double probability_right(const Evidence& evidence);

/// Of the animal's legs.
enum Leg { left_fore, right_fore, left_hind, right_hind };

/// An animal in a curve: which of its nodes are whose, as ways along it.
template <typename Scalar = double>
struct Limbs {
    std::array<std::vector<int>, 4> legs; ///< by Leg, from the foot's end to the trunk
    std::vector<int> trunk;               ///< from the hind legs to the fore legs
    std::vector<int> neck;                ///< from there to the head's end
    std::vector<int> tail;                ///< from the trunk to its tip; empty where there is none
    BodyFrame<Scalar> frame;              ///< origin: where the hind legs meet
    Scalar size = 0;                      ///< length of the trunk and of a mean leg together
    Evidence evidence;
    double probability = 0;
};

/// Most ends of a curve that take part: those that add most to its length. Ears, horns, toes are more.
inline constexpr std::size_t most_ends = 10;

/// The likeliest ways to see a four-legged animal in a curve, the likeliest first, at most `most`. None where the curve
/// has fewer than five ends, more than `embedding::most_reduced_nodes`, or is in several pieces. Every choice of two
/// pairs of legs, a head and a tail among its ends is looked at: O(ends^6) of few operations, and the best 150 of them
/// closely. Left and right are told by up, where the legs do not point, and forward, where the head is.
template <typename Scalar>
[[nodiscard]] std::vector<Limbs<Scalar>> find_limbs(const CurveSkeleton<Scalar>& curve, std::size_t most);

} // namespace skelgen::quadruped

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/quadruped/impl/limbs.hpp>
#endif
