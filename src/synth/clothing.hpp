#pragma once

#include <skelgen/synth/garment.hpp>

#include "implicit_body.hpp"
#include "proportions.hpp"

namespace skelgen::synth {

/// Dresses the body. Garments are solid and grow together with what they touch, as they do in a scan.
void put_on(ImplicitBody& body, const Proportions& proportions, Garment garment);

} // namespace skelgen::synth
