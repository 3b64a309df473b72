#pragma once

#include <skelgen/synth/body.hpp>

#include "implicit_body.hpp"
#include "surface_mesher.hpp"

namespace skelgen::synth {

/// Gap that a mesh of the usual fineness keeps open, for a body of 1.75 m.
inline constexpr double least_gap = 0.007;

/// The field of a planned body without its clothes, and without what is missing. \throws Error usage as
/// `synthesize_body`.
[[nodiscard]] ImplicitBody naked_field(const BodyPlan& plan, const Proportions& proportions);

/// The same, dressed as planned.
[[nodiscard]] ImplicitBody dressed_field(const BodyPlan& plan, const Proportions& proportions);

/// The surface of the whole body, to be meshed as long as `body` lives.
[[nodiscard]] ImplicitSurface surface_of(const ImplicitBody& body, const Proportions& proportions);

} // namespace skelgen::synth
