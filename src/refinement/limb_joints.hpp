#pragma once

#include <skelgen/refinement/limbs.hpp>
#include <skelgen/refinement/refine.hpp>

#include "placement.hpp"

namespace skelgen::detail {

/// Joints at the template's length ratios (LF20 3.1), counted from the limb's end, which the mesh shows, not from the
/// trunk, where the curve is anybody's guess.
void place_by_ratio(Placement& placement, const Limb& limb);

/// Neck: brought nearer to its height below the throat.
void place_neck(Placement& placement, const Limb& limb, const HeadShape& head, const RefinementOptions& options);

/// Wrist: the thinnest section near it (LF20 3.2.2).
void place_wrist(Placement& placement, const Limb& limb, const RefinementOptions& options);

/// Elbow, knee: at its length ratio when straight, near where the lines of its two bones meet when bent. The lines meet
/// a little outside of the joint, as folded flesh pushes both of them out, and the centreline passes inside of it.
void place_bend(Placement& placement, const Limb& limb, const RefinementOptions& options);

/// Shoulder, hip: the limb's own sections end short of them; the line of the bone goes on to its length. Where the bone
/// shows too little of itself, in a deep crouch or behind crossed arms, that line points anywhere: then of all the ways
/// to go on the one that keeps the rest-pose distance from the neck best, which must have been placed.
void place_girdle(Placement& placement, const Limb& limb, const RefinementOptions& options);

} // namespace skelgen::detail
