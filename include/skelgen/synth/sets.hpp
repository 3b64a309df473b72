#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <skelgen/synth/body.hpp>

namespace skelgen::synth {

/// The sets that `body_set` knows.
///
/// - scape: one person, 71 poses
/// - faust: 10 people, 10 poses
/// - proportions: children, very heavy, long and short limbs
/// - partial: feet, hands or an arm missing
/// - joined: arms, hands and thighs grown together
/// - scan: noise, holes, floating pieces, flipped patches, pinched vertices
/// - dressed: skirt, coat, trousers, boots, hat, long hair, rucksack
/// - pieces: limbs that are closed or open by themselves, seams, eyes and teeth, clothes as shells
/// - cartoon: heads, hands, feet and limbs of all sizes, paws, boots, horns, a tail
/// - curled: squatting, kneeling, knees to the chest, hands in the lap, behind the back and on knees and shoulders: a
///   few millimetres apart, and grown together
/// - mouths: open, with a cavity behind the lips
/// - hands: of two to five digits, open, curled and spread, grown together, in gloves, as fists, missing, or around a
///   rod, a staff or a ball. The left one and the right one are drawn by themselves; a third is beside the thighs
/// - armed: staff, sword or axe in the right hand of people and figures, and a stout figure without
/// - characters: 100 drawn at random from proportions, poses, what can be worn and held, and kinds of pieces. Their
///   names say what they are
[[nodiscard]] std::vector<std::string> set_names();

/// What to synthesize for a set, in order. The same seed gives the same plans.
/// \throws Error usage naming the known sets.
[[nodiscard]] std::vector<BodyPlan> body_set(std::string_view name, std::uint64_t seed);

} // namespace skelgen::synth
