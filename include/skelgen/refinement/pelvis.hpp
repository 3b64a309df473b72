#pragma once

#include <optional>
#include <vector>

#include <skelgen/core/mesh.hpp>
#include <skelgen/core/options.hpp>
#include <skelgen/refinement/limbs.hpp>
#include <skelgen/refinement/placement.hpp>
#include <skelgen/refinement/trunk_axis.hpp>

namespace skelgen::refinement {

/// Where hips and root lie below the trunk, and how they turn with the thighs. Lengths in rest-pose thighs; calibrated
/// on registered bodies of five people, but for what is said otherwise.
struct PelvisOptions {
    double hips_above_fork = 0.16; ///< height of the hips above where the legs part, along the pelvis's own up
    double fork_rise = 0.04; ///< by how much the fork is higher per radian by which both thighs are flexed, whose skin
                             ///< takes it along; calibrated on one person's squats
    double tilt =
        0.21; ///< tangent of the angle by which the trunk's line leans forward from a standing pelvis's own up
    double rhythm = 0.29; ///< part of the flexion of both thighs against the trunk that is the pelvis's: between a
                          ///< fourth and a third (BGL85)
    double fork_deviation = 0.03;  ///< standard deviation of the height that the fork tells
    double thigh_deviation = 0.08; ///< standard deviation of a thigh's length, that of both being nearly one error
};

/// \throws Error usage when an option is out of its range.
inline void validate(const PelvisOptions& options) {
    core::require_in_range("refinement.pelvis.hips_above_fork", options.hips_above_fork, -1.0, 1.0);
    core::require_in_range("refinement.pelvis.fork_rise", options.fork_rise, -1.0, 1.0);
    core::require_in_range("refinement.pelvis.tilt", options.tilt, -1.0, 1.0);
    core::require_in_range("refinement.pelvis.rhythm", options.rhythm, 0.0, 1.0);
    core::require_in_range("refinement.pelvis.fork_deviation", options.fork_deviation, 1e-3, 100.0);
    core::require_in_range("refinement.pelvis.thigh_deviation", options.thigh_deviation, 1e-3, 100.0);
}

/// Hips and root brought to the pelvis, as trunk and thighs together tell it. Its hips point along the line between the
/// thighs' and across the trunk, where these agree; it is turned against the trunk as the spine bends between them: by
/// so much as the hips' line is, and by its part of the flexion of both thighs. From the trunk's place it lies along
/// the chord of that bend, as far below as the fork and the lengths of the thighs together tell; off the chord, and
/// turned with it, as the middle between the thighs' hips does, where that is not far off. Hips and knees must have
/// been placed; of a hem's height nothing is told. None where there are no two legs, or the hips lie along the axis.
/// O(limbs).
template <typename Scalar>
[[nodiscard]] std::optional<Placement<Scalar>>
place_pelvis(Placement<Scalar> placement, const std::vector<Limb<Scalar>>& limbs, const TrunkAxis<Scalar>& axis,
             const PelvisOptions& options = {});

} // namespace skelgen::refinement

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/refinement/impl/pelvis.hpp>
#endif
