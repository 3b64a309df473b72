#pragma once

#include <array>

#include <skelgen/refinement/cross_section.hpp>
#include <skelgen/refinement/end_points.hpp>
#include <skelgen/refinement/limbs.hpp>
#include <skelgen/refinement/trunk_axis.hpp>

namespace skelgen::refinement {

/// A leg and where it ends; refers to both.
template <typename Scalar>
struct LegToEnd {
    const Limb<Scalar>& limb;
    const EndPoint<Scalar>& end;
};

/// Is it no crotch where the legs seem to part, but the hem of a skirt, a coat or a robe? A trunk goes over into two
/// legs that are together about as large: across the axis, its section above a hem is more than twice both legs'
/// sections below it, and larger than the waist's. Told of legs that hang down from there; those that are raised or
/// folded have other sections. `axis`: with its fork; `thigh`: rest-pose length in the body's unit. O(log m) for each
/// face that is cut.
template <typename Scalar>
[[nodiscard]] bool is_hem(const Slicer<Scalar>& slicer, const std::array<LegToEnd<Scalar>, 2>& legs,
                          const TrunkAxis<Scalar>& axis, Scalar thigh);

} // namespace skelgen::refinement

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/refinement/impl/hem.hpp>
#endif
