#pragma once

#include <limits>
#include <optional>
#include <vector>

#include <skelgen/core/mesh.hpp>
#include <skelgen/refinement/cross_section.hpp>
#include <skelgen/refinement/fork.hpp>

namespace skelgen::refinement {

/// The centreline of the lower trunk where thighs do not disturb its sections, as a straight line, and how these lie.
template <typename Scalar = double>
struct TrunkAxis {
    Vector3<Scalar> place; ///< middle of that part of the centreline
    Vector3<Scalar> up;    ///< unit, along it, away from the legs
    Vector3<Scalar> fork;  ///< where the legs part, on the surface
    /// Along which the sections are widest, of either sense: from side to side. As long as they are narrower the other
    /// way, 0 (round) to 1.
    Vector3<Scalar> across = Vector3<Scalar>::Zero();
    Scalar largest_section =
        std::numeric_limits<Scalar>::infinity(); ///< area from which on a section holds a thigh, too
    bool is_hem = false;                         ///< is the fork no crotch, but the hem of a skirt or a coat?
    /// Among which `fork` is, for who knows the pelvis's own up; none: it stays where it is.
    std::vector<Crossing<Scalar>> crossings = {};
};

/// Finds the axis of the lower trunk by its sections a third to two thirds of a thigh above its fork, or higher where
/// raised thighs widen these. It goes with the pelvis however the legs are held. `line`: k x 3, roughly through the
/// trunk, from the fork up to the neck; `thigh`: rest-pose length in the body's unit. None where the trunk shows no
/// such sections. O(sections (n + m)).
template <typename Scalar>
[[nodiscard]] std::optional<TrunkAxis<Scalar>> find_trunk_axis(const Slicer<Scalar>& slicer, const Points<Scalar>& line,
                                                               Scalar thigh);

} // namespace skelgen::refinement

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/refinement/impl/trunk_axis.hpp>
#endif
