#pragma once

#include <skelgen/core/options.hpp>
#include <skelgen/refinement/bend.hpp>
#include <skelgen/refinement/bone_line.hpp>
#include <skelgen/refinement/head.hpp>
#include <skelgen/refinement/limbs.hpp>
#include <skelgen/refinement/placement.hpp>

namespace skelgen::refinement {

/// Where the neck's joint is from the throat; calibrated between registered and landmarked bodies.
struct NeckOptions {
    double below_throat = 0.07;    ///< of the distance from neck to top of the head
    double throat_weight = 0.6;    ///< of the throat against the place by ratio: 0 to 1
    double farthest_forward = 0.2; ///< of the same distance: what is farther before that place is a chin, and says the
                                   ///< neck's height alone; 87 registered and landmarked bodies have it within 0.192
};

/// Where the wrist may be.
struct WristOptions {
    double window = 0.2;   ///< of the forearm: how far from its place the thinnest section is looked for
    double stiffness = 14; ///< what a section so many forearms off costs, squared, against the logarithm of thickness:
                           ///< a tenth of the forearm off it must be thinner by 14 %. Calibrated on registered bodies
};

/// When the line of an upper arm is not believed, and how much.
struct GirdleOptions {
    double tolerance = 0.6;      ///< of the rest-pose distance between shoulder and neck: how far a shoulder may be off
    double height_weight = 0.35; ///< of the height at which people hold their shoulders, against that by the arm's line
    double farthest_height = 0.25; ///< of the trunk: how far from that height the arm's line is believed; of 192 arms
                                   ///< of registered and landmarked bodies none is farther than 0.143
};

/// \throws Error usage when an option is out of its range.
inline void validate(const NeckOptions& options) {
    core::require_in_range("refinement.neck.below_throat", options.below_throat, -1.0, 1.0);
    core::require_in_range("refinement.neck.throat_weight", options.throat_weight, 0.0, 1.0);
    core::require_in_range("refinement.neck.farthest_forward", options.farthest_forward, 0.0, 100.0);
}

/// \throws Error usage when an option is out of its range.
inline void validate(const WristOptions& options) {
    core::require_in_range("refinement.wrist.window", options.window, 0.0, 0.5);
    core::require_in_range("refinement.wrist.stiffness", options.stiffness, 0.0, 1e4);
}

/// \throws Error usage when an option is out of its range.
inline void validate(const GirdleOptions& options) {
    core::require_in_range("refinement.girdle.tolerance", options.tolerance, 0.0, 100.0);
    core::require_in_range("refinement.girdle.height_weight", options.height_weight, 0.0, 1.0);
    core::require_in_range("refinement.girdle.farthest_height", options.farthest_height, 0.0, 100.0);
}

/// Joints at the template's length ratios (LF20 section 3.1), counted from the limb's end, which the mesh shows, not
/// from the trunk, where the curve is anybody's guess.
template <typename Scalar>
[[nodiscard]] Placement<Scalar> place_by_ratio(Placement<Scalar> placement, const Limb<Scalar>& limb);

/// Neck: brought nearer to its place below the throat; it stands under the back of a head, not under the chin. Where
/// the limb does not begin with a neck, or the head shows no throat, nothing moves.
template <typename Scalar>
[[nodiscard]] Placement<Scalar> place_neck(Placement<Scalar> placement, const Limb<Scalar>& limb,
                                           const HeadShape<Scalar>& head, const NeckOptions& options = {});

/// Wrist: the thinnest section near it (LF20 section 3.2.2), the thinner the farther off; between sections where
/// a parabola through the thinnest one and its neighbours says. Fists and bent elbows spoil its place by ratio.
template <typename Scalar>
[[nodiscard]] Placement<Scalar> place_wrist(Placement<Scalar> placement, const Limb<Scalar>& limb,
                                            const WristOptions& options = {});

/// Elbow, knee: at its length ratio when straight, near where the lines of its two bones meet when bent. The lines meet
/// a little outside of the joint, as folded flesh pushes both of them out, and the centreline passes inside of it.
template <typename Scalar>
[[nodiscard]] Placement<Scalar> place_bend(Placement<Scalar> placement, const Limb<Scalar>& limb,
                                           const BendOptions& options = {}, const BoneLineOptions& bone_line = {});

/// Shoulder, hip: the limb's own sections end short of them; the line of the bone goes on to its length. Where the bone
/// shows too little of itself, in a deep crouch or behind crossed arms, that line points anywhere: then of all the ways
/// to go on the one that keeps the rest-pose distance from the neck best, which must have been placed.
template <typename Scalar>
[[nodiscard]] Placement<Scalar> place_girdle(Placement<Scalar> placement, const Limb<Scalar>& limb,
                                             const GirdleOptions& options = {}, const BoneLineOptions& bone_line = {});

/// Shoulder: brought along the trunk nearer to the height below the neck at which people hold it, which rises with the
/// arm (ISA44) and sinks on the side to which the head is leant; the sections of an upper arm lean towards the armpit.
/// One that is farther from it than people's are is the end of a line that is wrong: turned to it about the elbow.
/// Neck, head, hips, elbow and shoulder must have been placed. Other limbs stay, as do shoulders that would move
/// farther than the upper arm is thick: no section leans so far.
template <typename Scalar>
[[nodiscard]] Placement<Scalar> place_shoulder_by_height(Placement<Scalar> placement, const Limb<Scalar>& limb,
                                                         const GirdleOptions& options = {});

/// Shoulder that lies far from the neck where the trunk is longer than the limbs say, as those of a body that folds up
/// look shorter than they are: on the upper arm's line, as far from the neck, which must have been placed, as it is in
/// the rest pose for the distance from neck to fork; where the line stays farther off, at the nearest place, unless
/// that is far, too. A straight arm's elbow goes with it by the forearm's part of the arm. Other limbs stay.
template <typename Scalar>
[[nodiscard]] Placement<Scalar> place_shoulder_by_trunk(Placement<Scalar> placement, const Limb<Scalar>& limb,
                                                        const Vector3<Scalar>& fork, const BendOptions& bend = {},
                                                        const BoneLineOptions& bone_line = {});

} // namespace skelgen::refinement

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/refinement/impl/limb_joints.hpp>
#endif
