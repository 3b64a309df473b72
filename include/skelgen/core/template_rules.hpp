#pragma once

#include <string_view>

#include <skelgen/core/skeleton_template.hpp>

namespace skelgen {

/// The spelling in files: "pelvis", "waist", ..., "foot".
[[nodiscard]] std::string_view to_string(JointRole role);

/// The spelling in files: "human", "quadruped".
[[nodiscard]] std::string_view to_string(BodyKind plan);

/// The spelling in files: "none", "left", "right".
[[nodiscard]] std::string_view to_string(Side side);

/// Checks that `skeleton_template` is a skeleton that the stages can look for, of a person unless its plan says
/// otherwise:
/// - joint names are unique and not empty, positions finite, no bone has length zero;
/// - it is one tree, parents before children, rooted in the pelvis;
/// - it has one pelvis, one chest and one head, any number of waists and necks, and limb joints once on each side,
/// hands,
///   hips, knees and feet among them: the sides are told by how legs bend and where feet point;
/// - pelvis, waist, chest, neck, head follow in this order along the trunk, shoulder, elbow, wrist, hand along an arm,
///   which starts at the chest, and hip, knee, ankle, foot along a leg, which starts at the pelvis; waist, neck,
///   shoulder, elbow, wrist and ankle may be left out;
/// - every branch ends in the head, a hand or a foot, and only these may have a tip, at a distance from the joint;
/// - left and right have the same joints, left at larger x; the trunk's upper end (the first neck, or else the chest)
/// is
///   higher (at larger y) than the hips.
///
/// A template of the plan quadruped need not follow the third to fifth of these; it has two waists, two necks and four
/// joints of the tail at most, and fore legs have the roles of arms.
/// \throws Error bad_input naming the joint and the rule that it breaks. O(joints^2).
void validate_template(const SkeletonTemplate& skeleton_template);

} // namespace skelgen

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/core/impl/template_rules.hpp>
#endif
