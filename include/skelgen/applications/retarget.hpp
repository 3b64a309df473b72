#pragma once

#include <skelgen/applications/animation.hpp>
#include <skelgen/applications/motion_clip.hpp>
#include <skelgen/applications/rig.hpp>
#include <skelgen/core/outcome.hpp>
#include <skelgen/core/skeleton_template.hpp>

namespace skelgen::applications {

/// Has a rig move as the skeleton of a clip does, whatever the proportions, units and rest poses of both. Joints
/// correspond by their names (`find_body`). Upper arms, forearms, thighs and calves point where the clip's do. How they
/// are turned about themselves, and how trunk, head, hands and feet are turned, is what has changed since the clip's
/// rest pose. There a body that stands symmetric is taken to stand upright, with its hands straight and its feet flat.
/// A rest pose that is no such pose counts as the body that it shows, and where it shows none (bones folded into a
/// line), the first frame does. The root moves as the middle of the clip's hips, scaled by the legs' lengths; it starts
/// above the origin, and the feet come to the floor (`on_floor`). The axis of the clip's coordinates in which its
/// skeleton stands becomes +y, and a clip at rest faces +z. \returns a failure where the clip has no body, or one whose
/// left and right are exchanged, or whose legs are next to nothing beside its ways. \throws Error usage when the rig's
/// joints are not the template's, or a frame has not as many numbers as the clip has channels. O(frames joints).
template <typename Scalar>
[[nodiscard]] Outcome<Animation<Scalar>> retarget(const MotionClip& clip, const Rig<Scalar>& rig,
                                                  const SkeletonTemplate& skeleton_template);

} // namespace skelgen::applications

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/applications/impl/retarget.hpp>
#endif
