#pragma once

#include <skelgen/synth/pieces.hpp>

#include "implicit_body.hpp"

namespace skelgen::synth {

/// The body made of pieces that are not connected, about `faces` triangles in all. `naked` and `dressed` are the same
/// body without and with its clothes. `one_body`: no piece has handles.
/// \throws Error internal when a piece cannot be meshed.
[[nodiscard]] TriangleMesh<double> put_together(const ImplicitBody& naked, const ImplicitBody& dressed,
                                                const Proportions& proportions, const BodyPieces& pieces, int faces,
                                                bool one_body);

} // namespace skelgen::synth
