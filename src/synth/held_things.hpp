#pragma once

#include <skelgen/synth/body.hpp>

#include "implicit_body.hpp"

namespace skelgen::synth {

/// The mesh with what the hands of a planned body hold, pieces of their own. The mesh lies lower than the field by
/// `ground`, metres.
[[nodiscard]] TriangleMesh<double> with_held_things(TriangleMesh<double> mesh, const ImplicitBody& field,
                                                    const BodyPlan& plan, double ground);

} // namespace skelgen::synth
