#pragma once

#include <optional>
#include <vector>

#include <skelgen/core/mesh.hpp>
#include <skelgen/core/options.hpp>
#include <skelgen/refinement/cross_section.hpp>
#include <skelgen/refinement/limbs.hpp>
#include <skelgen/refinement/placement.hpp>

namespace skelgen::refinement {

/// Where hips and root lie in the lower trunk. Lengths in rest-pose thighs; calibrated on registered bodies of five
/// people, but for the deviations, which are working values.
struct PelvisOptions {
    double hips_above_fork = 0.15; ///< height of the hips above where the legs part, along the pelvis's own up
    double tilt = 0.21; ///< tangent of the angle by which the trunk's line leans forward from the pelvis's own up
    double fork_deviation = 0.06;  ///< standard deviation of the height that the fork tells
    double thigh_deviation = 0.05; ///< standard deviation of a thigh's length
};

/// \throws Error usage when an option is out of its range.
inline void validate(const PelvisOptions& options) {
    core::require_in_range("refinement.pelvis.hips_above_fork", options.hips_above_fork, -1.0, 1.0);
    core::require_in_range("refinement.pelvis.tilt", options.tilt, -1.0, 1.0);
    core::require_in_range("refinement.pelvis.fork_deviation", options.fork_deviation, 1e-3, 100.0);
    core::require_in_range("refinement.pelvis.thigh_deviation", options.thigh_deviation, 1e-3, 100.0);
}

/// The centreline of the lower trunk where thighs do not disturb its sections, as a straight line.
template <typename Scalar = double>
struct TrunkAxis {
    Vector3<Scalar> place; ///< middle of that part of the centreline
    Vector3<Scalar> up;    ///< unit, along it, away from the legs
    Vector3<Scalar> fork;  ///< where the legs part, on the surface
};

/// Finds the axis of the lower trunk by its sections a third to two thirds of a thigh above `fork`, or higher where
/// raised thighs widen these. It goes with the pelvis however the legs are held. `line`: k x 3, roughly through the
/// trunk, from the fork up to the neck; `thigh`: rest-pose length in the body's unit. None where the trunk shows no
/// such sections. O(sections (n + m)).
template <typename Scalar>
[[nodiscard]] std::optional<TrunkAxis<Scalar>> find_trunk_axis(const Slicer<Scalar>& slicer, const Points<Scalar>& line,
                                                               Scalar thigh);

/// Hips and root brought to the lower trunk, with which the pelvis is one: on its axis, the hips level with each other,
/// as high as the fork and the lengths of the thighs together tell. Hips and knees must have been placed. None where
/// there are no two legs, or the hips lie along the axis. O(limbs).
template <typename Scalar>
[[nodiscard]] std::optional<Placement<Scalar>>
place_pelvis(Placement<Scalar> placement, const std::vector<Limb<Scalar>>& limbs, const TrunkAxis<Scalar>& axis,
             const PelvisOptions& options = {});

} // namespace skelgen::refinement

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/refinement/impl/pelvis.hpp>
#endif
