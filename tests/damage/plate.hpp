#pragma once

#include <skelgen/core/kinematic_skeleton.hpp>

#include "soup.hpp"

namespace skelgen::damage {

/// A box under a standing body: wide enough for its feet and a tenth of its height more on each side, a hundredth of
/// its height thick, its top `gap` heights below the lowest vertex (negative: above it). Up is the coordinate axis
/// nearest to the way from the feet to the head. \throws Error bad_input when the skeleton has no feet or no head.
[[nodiscard]] Mesh plate_below(const Mesh& body, const KinematicSkeleton<double>& skeleton, double gap);

} // namespace skelgen::damage
