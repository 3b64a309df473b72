#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <skelgen/core/polyline.hpp>
#include <skelgen/core/skeleton_template.hpp>
#include <skelgen/refinement/centreline.hpp>
#include <skelgen/refinement/cross_section.hpp>
#include <skelgen/refinement/end_points.hpp>

namespace skelgen::refinement {

/// One chain of the template that ends at a tip (an arm, a leg, the head), and the centreline it lies on.
template <typename Scalar = double>
struct Limb {
    std::vector<int> joints; ///< template joints after the branching one, outwards; the last one ends the limb
    Centreline<Scalar> line; ///< from the branching node to the tip on the surface
    std::vector<Scalar>
        from_tip; ///< per joint its rest-pose distance from the tip along the template, scaled to this body
    std::optional<Scalar> top_by_trunk; ///< distance of the first joint from the tip as the trunk's shape tells it:
                                        ///< the fork of the legs, the armpit
    Scalar top_deviation = 0;           ///< standard deviation of that
    std::size_t missing = 0;            ///< how many of the last joints are cut off
    Scalar attachment =
        0; ///< arc length on `line` where the limb leaves the trunk: nearer the start sections are not its own
};

/// Where the limb ends on the surface.
template <typename Scalar>
[[nodiscard]] Vector3<Scalar> tip_of(const Limb<Scalar>& limb) {
    return limb.line.points.template bottomRows<1>().transpose();
}

/// Arc length on the limb's centreline at its joint number `i`.
template <typename Scalar>
[[nodiscard]] Scalar arc_of(const Limb<Scalar>& limb, std::size_t i) {
    return limb.line.arc[limb.line.arc.size() - 1] - limb.from_tip[i];
}

/// The centreline's point at that arc length, clamped to its ends. O(log k).
template <typename Scalar>
[[nodiscard]] Vector3<Scalar> point_on(const Limb<Scalar>& limb, Scalar arc) {
    return core::point_at(limb.line.points, limb.line.arc, arc);
}

/// Index in the limb of its first joint of that role; none when it has none.
template <typename Scalar>
[[nodiscard]] std::optional<std::size_t> find_in_limb(const Limb<Scalar>& limb,
                                                      const SkeletonTemplate& skeleton_template, JointRole role) {
    for (std::size_t i = 0; i < limb.joints.size(); ++i)
        if (skeleton_template.joint(limb.joints[i]).role == role) return i;
    return std::nullopt;
}

/// Indices of the two limbs that begin with hip and knee; empty where there are not two. O(limbs).
template <typename Scalar>
[[nodiscard]] std::vector<std::size_t> find_legs(const std::vector<Limb<Scalar>>& limbs,
                                                 const SkeletonTemplate& skeleton_template) {
    std::vector<std::size_t> legs;
    for (std::size_t i = 0; i < limbs.size(); ++i)
        if (limbs[i].joints.size() >= 2 && skeleton_template.joint(limbs[i].joints.front()).role == JointRole::hip)
            legs.push_back(i);
    if (legs.size() != 2) legs.clear();
    return legs;
}

/// Length of a limb's first bone, upper arm or thigh, in the template's rest pose. The limb must have two joints.
template <typename Scalar>
[[nodiscard]] Scalar rest_length_of_first_bone(const Limb<Scalar>& limb, const SkeletonTemplate& skeleton_template) {
    return static_cast<Scalar>(rest_length(skeleton_template, limb.joints[0], limb.joints[1]));
}

/// Rest-pose length to body length, from the geodesic diameter of the body (in the body's unit; the template's may be
/// any).
template <typename Scalar>
[[nodiscard]] Scalar template_scale(const SkeletonTemplate& skeleton_template, Scalar geodesic_diameter);

/// Centres of the rings around a limb at equal geodesic distance from its end, from `length` away in steps of `step`
/// down to the end itself. Each is looked for near the last one: where the end touches another part of the body, that
/// has rings at the same distance. O(m length / step).
template <typename Scalar>
[[nodiscard]] Points<Scalar> ring_centres(const Slicer<Scalar>& slicer, const EndPoint<Scalar>& end, Scalar length,
                                          Scalar step);

/// The limb with its centreline and attachment, from its end and `from_tip`: through the centres of the rings at equal
/// geodesic distance from the end, which follow any bend and never stray to another part of the body, then recentred by
/// perpendicular sections. O(length / step (n + m)).
template <typename Scalar>
[[nodiscard]] Limb<Scalar> draw_limb(Limb<Scalar> limb, const Slicer<Scalar>& slicer, const EndPoint<Scalar>& end,
                                     const CentrelineOptions& options = {});

/// A limb whose joints have come nearer to its tip, on so much of the centreline that it has as it would be drawn with
/// now. O(k).
template <typename Scalar>
[[nodiscard]] Limb<Scalar> shorten_line(Limb<Scalar> limb);

/// All limbs of an embedded template, in the order of their ends, their joints at the template's distances.
template <typename Scalar>
[[nodiscard]] std::vector<Limb<Scalar>>
trace_limbs(const Slicer<Scalar>& slicer, const std::vector<EndPoint<Scalar>>& ends,
            const SkeletonTemplate& skeleton_template, Scalar scale, const CentrelineOptions& options = {});

} // namespace skelgen::refinement

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/refinement/impl/limbs.hpp>
#endif
