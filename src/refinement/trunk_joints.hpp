#pragma once

#include <skelgen/core/curve_skeleton.hpp>
#include <skelgen/embedding/embed.hpp>
#include <skelgen/refinement/cross_section.hpp>
#include <skelgen/refinement/refine.hpp>

#include "placement.hpp"

namespace skelgen::detail {

/// Hips: on the line between them (LF20 3.2.2), at their rest-pose distance. The line of a thigh passes its hip on the
/// outside, since a thigh bone runs inwards from the hip's neck.
void narrow_hips(Placement& placement);

/// Trunk: from the middle of the hips (`root` where the template has none) to the neck, joints at their rest-pose
/// heights; the waist in the centre of its section, and the nearer to the hips the more they are flexed.
void place_trunk(Placement& placement, const Slicer& slicer, const Vector3<double>& root,
                 const RefinementOptions& options);

/// Crotch: nearer to the surface than a thigh is thick, it lies too low and moves towards the waist (LF20 3.2.2).
void raise_crotch(Placement& placement, const TriangleMesh<double>& mesh, const RefinementOptions& options);

} // namespace skelgen::detail
