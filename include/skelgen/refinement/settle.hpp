#pragma once

#include <string>
#include <vector>

#include <skelgen/core/curve_skeleton.hpp>
#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/core/skeleton_template.hpp>

namespace skelgen {

/// Sets every joint's confidence by the bones that meet in it: 1 where they are as long as those of the other side and
/// as the template's at the skeleton's own scale; about half where they differ by a sixth from the other side's, or by
/// a third from the template's; short bones count for less. On real and synthetic bodies 98 of 100 joints above 0.7 lie
/// within 3 % of the geodesic diameter from the true place, 94 of those between 0.1 and 0.7, 30 of those below. Joints
/// below 0.1 are named in a warning; where one of an arm or a leg is among them, it may lie on the other side:
/// `sides_confidence` falls to 0.75 of itself. \returns how many there are.
int judge_joints(KinematicSkeleton<double>& skeleton, const SkeletonTemplate& skeleton_template);

/// Moves joints from the middle of their sections to their bones, which lie off the middle where flesh covers them
/// unevenly: a knee to the front and the outside of it, and towards the ankle when it is bent, hip and shoulder
/// outwards along their limbs, the shoulder to the front, too, the neck's base to the back. `skeleton` is in template
/// order, with its sides told. Calibrated: mean offsets from 50 registered bodies and from landmarks of 11 people,
/// halfway between.
void move_to_bones(KinematicSkeleton<double>& skeleton, const SkeletonTemplate& skeleton_template);

/// Brings the bones of both sides to like lengths, as they are in people: where a bone of a limb and its counterpart
/// differ by more than 4 % (and less than a third), their joints move along them, as little as that takes
/// (position-based dynamics, Müller et al. 2007).
void balance_bones(KinematicSkeleton<double>& skeleton, const SkeletonTemplate& skeleton_template);

/// Moves joints that landed outside the surface to the nearest place inside on the way to the curve skeleton, with a
/// warning each and half their confidence. \throws Error no_skeleton where that is more than one joint in six: no body
/// has so many there. O(joints n).
void keep_inside(KinematicSkeleton<double>& skeleton, const TriangleMesh<double>& mesh,
                 const CurveSkeleton<double>& curve);

/// Sets every joint's radius: mean distance to the contour around it across the bone from its parent (for the root: to
/// a child). 0 where there is no contour. O(joints (n + m)).
void measure_radii(KinematicSkeleton<double>& skeleton, const TriangleMesh<double>& mesh);

} // namespace skelgen
