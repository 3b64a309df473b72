#pragma once

#include <string>
#include <vector>

#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/core/skeleton_template.hpp>
#include <skelgen/refinement/refine.hpp>

namespace skelgen {

/// What the witnesses say, and the frame that follows.
struct SidesDecision {
    bool swap_legs = false; ///< the legs labelled left and right have to change places
    bool swap_arms = false;
    double confidence = 0; ///< |sum of votes| / sum of |votes|, damped where all witnesses are weak; 0 to 1
    std::vector<SideVote> votes;
    BodyFrame<double> frame;
};

/// Weights of the witnesses.
struct SidesOptions {
    double foot = 1.0;   ///< feet point forward (LF20 section 3.3)
    double knee = 0.5;   ///< a knee bends backward only
    double elbow = 0.15; ///< an elbow brings the hand forward, more often than not
    double head = 0.4;   ///< a face looks forward (Rau & Brunnett 2012)
    double trunk = 0.4;  ///< a back is flatter than a belly
};

/// Tells left from right by where the feet point in the standing pose, with knees, elbows, head and trunk as further
/// witnesses, and builds the body frame: up from between the hips to the waist, forward by the feet. \throws Error
/// no_skeleton when the template's legs or trunk have no length.
[[nodiscard]] SidesDecision decide_sides(const RefinedJoints& joints, const SkeletonTemplate& skeleton_template,
                                         const SidesOptions& options = {});

/// The kinematic skeleton with limbs exchanged as decided. Names and order are the template's.
[[nodiscard]] KinematicSkeleton<double> assemble(const RefinedJoints& joints, const SkeletonTemplate& skeleton_template,
                                                 const SidesDecision& sides);

} // namespace skelgen
