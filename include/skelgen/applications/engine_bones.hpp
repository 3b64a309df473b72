#pragma once

#include <skelgen/applications/animation.hpp>
#include <skelgen/applications/rig.hpp>

namespace skelgen::applications {

/// The joints that engines know and the template has none of.
struct EngineBones {
    bool engine = false; ///< root on the floor below the hips, upper_chest, left_clavicle and right_clavicle
    bool twist = false;  ///< SIDE_upper_arm_twist, SIDE_forearm_twist and SIDE_thigh_twist
};

/// A rig with these bones; none of its own is moved, and as long as none of the new ones moves by itself the mesh bends
/// as before. Neck and clavicles are carried by upper_chest, shoulders by clavicles; what followed the chest is divided
/// among the three, smoothly: clavicles have the surface above and beside them, from the breastbone to the shoulder. A
/// twist bone ends at nothing and shares the surface of the bone that carries it: that of the forearm lies in its
/// middle, and has the half towards the wrist; those of upper arm and thigh lie in the joint, and have the half that is
/// next to it. A rig that has such bones already, or no chest, neck and shoulders, keeps what it has. O(vertices).
template <typename Scalar>
[[nodiscard]] Rig<Scalar> with_engine_bones(Rig<Scalar> rig, const EngineBones& bones);

/// An animation of a rig as one of the same rig with these bones: all joints that both have are held alike. The root
/// stays on the floor below the hips; upper chest and clavicles go with the chest; twist bones take half of what the
/// hand is turned about the forearm, and half of what upper arm and thigh are about themselves back.
/// O(frames joints). \throws Error usage when `rig` has not all joints of `plain`, or a pose is of another one.
template <typename Scalar>
[[nodiscard]] Animation<Scalar> with_engine_bones(Animation<Scalar> animation, const Rig<Scalar>& plain,
                                                  const Rig<Scalar>& rig);

} // namespace skelgen::applications

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/applications/impl/engine_bones.hpp>
#endif
