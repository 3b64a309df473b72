#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include <skelgen/core/evidence.hpp>
#include <skelgen/core/header_only.hpp>
#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/core/outcome.hpp>
#include <skelgen/core/skeleton_template.hpp>
#include <skelgen/refinement/refine.hpp>
#include <skelgen/symmetry/front_of_surface.hpp>

namespace skelgen::symmetry {

/// What tells left from right: numbers, positive where they are for the sides as these are labelled.
enum class SideWitness {
    foot,  ///< sum over both feet: how far they point forward in the standing pose (LF20 section 3.3)
    knee,  ///< sum over both: a knee bends backward only; sine of the bend about the axis across
    elbow, ///< the same of elbows, which bring hands forward more often than not: an arm turns in its shoulder
    head,  ///< how much narrower a head is in front (RB12), as refinement::HeadShape has it
    sole,  ///< how far the surface of the feet lies before the shins
    face,  ///< how far the vertices of the head lie before its surface: faces have more detail than backs of heads
    count
};

inline constexpr auto side_witness_count = static_cast<std::size_t>(SideWitness::count);

using SideEvidence = core::EvidenceOf<SideWitness>;

/// As skeletons' files spell it: "foot".
[[nodiscard]] std::string_view to_string(SideWitness witness);

/// What each witness that says anything adds to the log odds that the sides are right (sides_table.hpp).
[[nodiscard]] std::vector<SideVote> votes_of(const SideEvidence& evidence);

/// What the witnesses say, and the frame that follows.
template <typename Scalar = double>
struct SidesDecision {
    bool swap_legs = false; ///< the legs labelled left and right have to change places
    bool swap_arms = false;
    SideEvidence evidence; ///< of the sides as decided
    double confidence = 0; ///< 2 p - 1 of the probability p that they are right; 0 to 1
    BodyFrame<Scalar> frame;
};

/// Tells left from right by where the feet point in the standing pose (LF20 section 3.3) and the other witnesses, and
/// builds the body frame: up from between the hips to the waist (without one, to the chest), forward by the feet, the
/// origin in the root. (left, forward, up) is a left-handed triple. The arms follow the frame by the first joint that
/// they have, from the shoulder on. `skeleton_template` is one that validate_template accepts. `surface`: as
/// front_of_surface() finds it; what is zero says nothing. O(joints). \returns failure flat_trunk when the trunk or the
/// hips have no extent.
template <typename Scalar>
[[nodiscard]] Outcome<SidesDecision<Scalar>> decide_sides(const refinement::RefinedJoints<Scalar>& joints,
                                                          const SkeletonTemplate& skeleton_template,
                                                          const SurfaceFront<Scalar>& surface = {});

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
