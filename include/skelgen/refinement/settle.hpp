#pragma once

#include <string>
#include <vector>

#include <skelgen/core/curve_skeleton.hpp>
#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/core/skeleton_template.hpp>

namespace skelgen {

/// Moves joints from the middle of their sections to their bones, which lie off the middle where flesh covers them unevenly:
/// a knee to the front and the outside of it, the neck's base to the back. `skeleton` is in template order, with its sides
/// told. Calibrated: mean offsets from 50 registered bodies and from landmarks of 11 people, halfway between.
void move_to_bones(KinematicSkeleton<double>& skeleton, const SkeletonTemplate& skeleton_template);

/// Brings the bones of both sides to like lengths, as they are in people: where a bone of a limb and its counterpart differ
/// by more than 4 % (and less than a third), their joints move along them, as little as that takes (position-based dynamics, Müller et al. 2007).
void balance_bones(KinematicSkeleton<double>& skeleton, const SkeletonTemplate& skeleton_template);

/// Moves joints that landed outside the surface to the nearest place inside on the way to the curve skeleton, with a warning
/// each. O(joints n).
void keep_inside(KinematicSkeleton<double>& skeleton, const TriangleMesh<double>& mesh, const CurveSkeleton<double>& curve);

/// Sets every joint's radius: mean distance to the contour around it across the bone from its parent (for the root: to a
/// child). 0 where there is no contour. O(joints (n + m)).
void measure_radii(KinematicSkeleton<double>& skeleton, const TriangleMesh<double>& mesh);

} // namespace skelgen
