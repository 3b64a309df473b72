#pragma once

#include "implicit_body.hpp"
#include "surface_mesher.hpp"

namespace skelgen::synth {

/// The surface of the whole body, to be meshed as long as `body` lives.
[[nodiscard]] ImplicitSurface surface_of(const ImplicitBody& body, const Proportions& proportions);

} // namespace skelgen::synth
