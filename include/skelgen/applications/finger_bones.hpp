#pragma once

#include <cstddef>
#include <vector>

#include <skelgen/applications/animation.hpp>
#include <skelgen/applications/rig.hpp>
#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/core/skeleton_template.hpp>
#include <skelgen/hands/digit.hpp>

namespace skelgen::applications {

/// A rig with the bones of the digits that were found, behind its own joints: three a digit, below the wrist. What of a
/// vertex followed wrist and hand is divided among the wrist and the one digit that the vertex lies on, or, in the
/// palm, is nearest to, by where it is along that digit's bones: no vertex follows two. The joint in the middle of the
/// knuckles moves nothing then. Bones lie at rest as the hand does, y along them, x about which they bend towards the
/// palm on both sides. Feet (`hands::find_feet`) are divided likewise, two bones a toe below the ball of the foot.
/// `rig` as made of `mesh` and `skeleton`, `hands` and feet found there.
/// O(vertices log faces). \throws Error usage when the skeleton is not of that template.
template <typename Scalar>
[[nodiscard]] Rig<Scalar>
with_finger_bones(Rig<Scalar> rig, const TriangleMesh<Scalar>& mesh, const KinematicSkeleton<Scalar>& skeleton,
                  const SkeletonTemplate& skeleton_template, const std::vector<hands::Hand<Scalar>>& hands);

/// The rig without the joints behind its first `own`: what followed them follows the one that they hang on. O(n).
template <typename Scalar>
[[nodiscard]] Rig<Scalar> without_finger_bones(Rig<Scalar> rig, std::size_t own);

/// A motion of that for the rig with them: digits stay as they are in the hand. O(frames joints).
template <typename Scalar>
[[nodiscard]] Animation<Scalar> with_held_fingers(Animation<Scalar> animation, const Rig<Scalar>& rig);

} // namespace skelgen::applications

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/applications/impl/finger_bones.hpp>
#endif
