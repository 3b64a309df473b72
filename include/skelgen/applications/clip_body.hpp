#pragma once

#include <array>
#include <vector>

#include <skelgen/applications/motion_clip.hpp>
#include <skelgen/core/outcome.hpp>

namespace skelgen::applications {

/// The joints of an arm or a leg of a clip's skeleton, as indices.
struct ClipLimb {
    int upper = -1; ///< shoulder or hip
    int lower = -1; ///< elbow or knee
    int end = -1;   ///< wrist or ankle
    int tip = -1;   ///< knuckles or ball of the foot; -1 where the skeleton has none
};

/// Which joints of a clip's skeleton are whose. Each has a place, but what a skeleton may do without.
struct ClipBody {
    int pelvis = -1;        ///< from which both legs come
    std::vector<int> spine; ///< between pelvis and chest; may be empty
    int chest = -1;         ///< from which both arms come; may be the pelvis
    std::vector<int> neck;  ///< between chest and head; may be empty
    int head = -1;
    std::array<ClipLimb, 2> arms, legs; ///< left, right
};

/// Finds a body in a clip's skeleton by the names of its joints, as motion capture and animation programs commonly have
/// them: those of skelgen, SMPL, Mixamo and MotionBuilder (LeftUpLeg), VRM (leftUpperLeg), Biovision (LeftHip,
/// LeftKnee), Poser (lThigh, lShin), Daz (lThighBend), 3ds Max's Biped (L Thigh), Unreal (thigh_l), Acclaim (lfemur),
/// Motive (LUArm) and Blender's Rigify (thigh.L), with prefixes, numbers and any case. What names leave open is seen in
/// how the joints hang together: a LeftShoulder above a LeftArm is a collar bone; the last of a neck or spine above the
/// arms is the head where none is called so. \returns a failure that names what is missing. O(joints). \throws Error as
/// `validate`.
[[nodiscard]] Outcome<ClipBody> find_body(const MotionClip& clip);

} // namespace skelgen::applications

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/applications/impl/clip_body.hpp>
#endif
