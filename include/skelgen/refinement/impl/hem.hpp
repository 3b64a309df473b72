#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include <skelgen/core/geometry.hpp>
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

namespace detail {

/// How far above and below a fork sections are compared, in thighs: a hem need not be level.
template <typename Scalar>
inline constexpr Scalar above_hem = Scalar(0.05);
template <typename Scalar>
inline constexpr Scalar below_hem = Scalar(0.1);

/// A section above a fork that many times larger than both legs' below it is that of clothes. In the midst between 96
/// registered bodies, 1.5 at most, and generated skirts and coats, 2.3 and more; so are the next two values.
template <typename Scalar>
inline constexpr Scalar hollow = Scalar(2.1);

/// Clothes flare from the waist on: what is smaller than this part of the largest section of the trunk alone, a tenth
/// more than the waist, is a trunk that ends flat, as a block figure's.
template <typename Scalar>
inline constexpr Scalar narrowest_hem = Scalar(0.7);

/// What is so many times larger than that holds thighs that are raised before the trunk.
template <typename Scalar>
inline constexpr Scalar widest_hem = Scalar(1.5);

/// Cosine of the angle from which on a leg does not hang down: 45 degrees.
template <typename Scalar>
inline constexpr Scalar hanging = Scalar(0.7);

/// A leg whose ankle is nearer than this part of its length is folded, as in a squat: its knee is bent by 74 degrees.
template <typename Scalar>
inline constexpr Scalar folded_leg = Scalar(0.8);

/// Does the leg hang down from the fork, and stand or step?
template <typename Scalar>
bool hangs(const LegToEnd<Scalar>& leg, int fork, const Vector3<Scalar>& up, Scalar thigh) {
    const Centreline<Scalar>& line = leg.limb.line;
    const Scalar high_at = line.arc[line.arc.size() - 1] - leg.end.distance[fork] + Scalar(0.1) * thigh;
    const Scalar ankle_at = arc_of(leg.limb, leg.limb.joints.size() - std::min<std::size_t>(2, leg.limb.joints.size()));
    const Vector3<Scalar> high = point_on(leg.limb, high_at), low = point_on(leg.limb, high_at + Scalar(0.4) * thigh);
    const Scalar straight = (high - point_on(leg.limb, ankle_at)).norm();
    return (high - low).normalized().dot(up) > hanging<Scalar> && straight > folded_leg<Scalar> * (ankle_at - high_at);
}

/// Area of the leg's section across `up` through where, seen from its end, it is first as high as `place`; 0 for none.
template <typename Scalar>
Scalar area_at_height(const Limb<Scalar>& leg, const Slicer<Scalar>& slicer, const Vector3<Scalar>& place,
                      const Vector3<Scalar>& up, Scalar thigh) {
    Eigen::Index i = leg.line.points.rows() - 1;
    while (i > 0 && (core::point(leg.line.points, i) - place).dot(up) < 0) --i;
    const auto section = slicer.around(core::point(leg.line.points, i), up, Scalar(0.1) * thigh);
    return section ? section->area : Scalar(0);
}

} // namespace detail

/// Is it no crotch where the legs seem to part, but the hem of a skirt, a coat or a robe? A trunk goes over into two
/// legs that are together about as large: across the axis, its section above a hem is more than twice both legs'
/// sections below it, and larger than the waist's. Told of legs that hang down from there; those that are raised or
/// folded have other sections. `axis`: with its fork; `thigh`: rest-pose length in the body's unit. O(log m) for each
/// face that is cut.
template <typename Scalar>
bool is_hem(const Slicer<Scalar>& slicer, const std::array<LegToEnd<Scalar>, 2>& legs, const TrunkAxis<Scalar>& axis,
            Scalar thigh) {
    using namespace detail;
    const int fork = core::nearest_vertex(slicer.mesh(), axis.fork);
    if (!hangs(legs[0], fork, axis.up, thigh) || !hangs(legs[1], fork, axis.up, thigh)) return false;
    const auto above = slicer.around(axis.fork + above_hem<Scalar> * thigh * axis.up, axis.up, Scalar(0.3) * thigh);
    const Vector3<Scalar> below = axis.fork - below_hem<Scalar> * thigh * axis.up;
    const Scalar one = area_at_height(legs[0].limb, slicer, below, axis.up, thigh),
                 other = area_at_height(legs[1].limb, slicer, below, axis.up, thigh);
    if (!above || !(one > 0) || !(other > 0)) return false;
    const Scalar flare = above->area / axis.largest_section;
    return above->area > hollow<Scalar> * (one + other) && flare > narrowest_hem<Scalar> && flare < widest_hem<Scalar>;
}

} // namespace skelgen::refinement
