#pragma once

#include <vector>

#include <skelgen/core/header_only.hpp>
#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/core/outcome.hpp>
#include <skelgen/core/skeleton_template.hpp>
#include <skelgen/refinement/refine.hpp>

namespace skelgen::symmetry {

/// What the witnesses say, and the frame that follows.
template <typename Scalar = double>
struct SidesDecision {
    bool swap_legs = false; ///< the legs labelled left and right have to change places
    bool swap_arms = false;
    double confidence = 0; ///< |sum of votes| / sum of |votes|, damped where all witnesses are weak; 0 to 1
    std::vector<SideVote> votes;
    BodyFrame<Scalar> frame;
};

/// Weights of the witnesses: how far to trust each against a foot. Chosen by what a body can do, and checked by the
/// sides of synthetic and real bodies.
struct SidesOptions {
    double foot = 1.0;   ///< feet point forward (LF20 section 3.3)
    double knee = 0.5;   ///< a knee bends backward only, but seldom far
    double elbow = 0.15; ///< an elbow brings the hand forward, more often than not: an arm turns in its shoulder
    double head = 0.4;   ///< a face looks forward (RB12), give or take a quarter turn
    double trunk = 0.4;  ///< a back is flatter than a belly
};

/// The same weights for a body of unusual proportions: head and trunk count half. Of drawn figures whose feet told
/// their sides, 5 trunks of 8 and 2 heads of 5 agreed with the feet, of others nearly all.
[[nodiscard]] SidesOptions sides_of_figures(SidesOptions options);

/// \throws Error usage when a weight is out of its range.
void validate(const SidesOptions& options);

/// Tells left from right by where the feet point in the standing pose (LF20 section 3.3), with knees, elbows, head and
/// trunk as further witnesses, and builds the body frame: up from between the hips to the waist (without one, to the
/// chest), forward by the feet, the origin in the root. (left, forward, up) is a left-handed triple. The arms follow
/// the frame by the first joint that they have, from the shoulder on. `skeleton_template` is one that validate_template
/// accepts. O(joints). \returns failure flat_trunk when the trunk or the hips have no extent. \throws Error usage when
/// an option is out of its range.
template <typename Scalar>
[[nodiscard]] Outcome<SidesDecision<Scalar>> decide_sides(const refinement::RefinedJoints<Scalar>& joints,
                                                          const SkeletonTemplate& skeleton_template,
                                                          const SidesOptions& options = {});

/// The kinematic skeleton with limbs exchanged as decided. Names and order are the template's; radii and confidences
/// are not known yet. O(joints^2).
template <typename Scalar>
[[nodiscard]] KinematicSkeleton<Scalar> assemble(const refinement::RefinedJoints<Scalar>& joints,
                                                 const SkeletonTemplate& skeleton_template,
                                                 const SidesDecision<Scalar>& sides);

} // namespace skelgen::symmetry

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/symmetry/impl/sides.hpp>
#endif
