#pragma once

#include <cstdint>

#include <skelgen/synth/body.hpp>

namespace skelgen::synth {

/// One body of the set "characters", whatever others are drawn. One in four is in a random pose and one in three in
/// pieces. The name has the index and what is particular about the body, as in 016-walk-closed-sword-hat.
[[nodiscard]] BodyPlan character(std::uint64_t seed, std::uint64_t index);

} // namespace skelgen::synth
