#pragma once

#include <skelgen/refinement/bend.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <skelgen/core/geometry.hpp>

namespace skelgen::refinement {
namespace detail {

/// The part of either bone next to an elbow or knee that is left out of its line: folded flesh widens the sections
/// there. A working value, not a measured one, as are the next two.
template <typename Scalar>
inline constexpr Scalar folded_part = Scalar(0.2);

/// The part next to wrist or ankle, which disturb less than the joints at the trunk.
template <typename Scalar>
inline constexpr Scalar end_joint_part = Scalar(0.1);

/// How far from its place by ratio the lines of a joint's bones may meet, in the length of both bones together: farther
/// off they are not those of this joint.
template <typename Scalar>
inline constexpr Scalar farthest_meeting = Scalar(0.3);

/// 0 up to `from`, 1 from `to` on, smooth between.
template <typename Scalar>
Scalar smooth_step(Scalar from, Scalar to, Scalar x) {
    const Scalar t = std::clamp((x - from) / (to - from), Scalar(0), Scalar(1));
    return t * t * (3 - 2 * t);
}

/// Angle between unit directions.
template <typename Scalar>
Scalar degrees_between(const Vector3<Scalar>& a, const Vector3<Scalar>& b) {
    return std::acos(std::clamp(a.dot(b), Scalar(-1), Scalar(1))) * (180 / std::numbers::pi_v<Scalar>);
}

/// Arc length at the centreline's place that is nearest to `p`. O(k).
template <typename Scalar>
Scalar nearest_arc(const Centreline<Scalar>& line, const Vector3<Scalar>& p) {
    Scalar least = std::numeric_limits<Scalar>::infinity(), arc = 0;
    for (Eigen::Index i = 0; i + 1 < line.points.rows(); ++i) {
        const auto [distance, along] =
            core::nearest_on_segment<Scalar, 3>(p, core::point(line.points, i), core::point(line.points, i + 1));
        if (!(distance < least)) continue;
        least = distance;
        arc = line.arc[i] + along * (line.arc[i + 1] - line.arc[i]);
    }
    return arc;
}

} // namespace detail

template <typename Scalar>
std::optional<BonesAtBend<Scalar>> bones_at_bend(const Limb<Scalar>& limb, Scalar inner, Scalar here, Scalar outer,
                                                 const BendOptions& options, const BoneLineOptions& bone_line) {
    using detail::folded_part;
    const Scalar inner_start = std::max(limb.attachment, inner + joint_part<Scalar> * (here - inner));
    auto upper = fit_bone(limb.line, inner_start, here - folded_part<Scalar> * (here - inner), bone_line);
    if (!upper) upper = fit_bone(limb.line, inner_start, here, bone_line); // little of it is on its own
    const auto lower = fit_bone(limb.line, here + folded_part<Scalar> * (outer - here),
                                outer - detail::end_joint_part<Scalar> * (outer - here), bone_line);
    if (!upper || !lower) return std::nullopt;
    const auto meeting = meeting_point(*upper, *lower);
    if (!meeting) return std::nullopt;
    return BonesAtBend<Scalar>{*meeting,
                               detail::smooth_step(static_cast<Scalar>(options.from), static_cast<Scalar>(options.full),
                                                   detail::degrees_between(upper->direction, lower->direction))};
}

template <typename Scalar>
Fold<Scalar> find_fold(const Limb<Scalar>& limb, const Stretch<Scalar>& joints, const BendOptions& options,
                       const BoneLineOptions& bone_line) {
    constexpr int rounds = 3; // a much-bent joint is first looked for where its folded flesh has it
    const Scalar end = limb.line.arc[limb.line.arc.size() - 1];
    const Scalar upper = joints.inner - joints.middle, lower = joints.middle - joints.outer;
    const Vector3<Scalar> first = point_on(limb, end - joints.middle);
    Scalar here = end - joints.middle;
    std::optional<BonesAtBend<Scalar>> bones;
    for (int round = 0; round < rounds; ++round) {
        if (bones) here += bones->bent * (detail::nearest_arc(limb.line, bones->meeting) - here);
        bones = bones_at_bend(limb, here - upper, here, end - joints.outer, options, bone_line);
        const bool is_this_joint =
            bones && (bones->meeting - first).norm() <= detail::farthest_meeting<Scalar> * (upper + lower);
        if (!is_this_joint || !(bones->bent > 0)) return {};
    }
    const Scalar before = here - detail::folded_part<Scalar> * upper,
                 after = here + detail::folded_part<Scalar> * lower;
    const Scalar way =
        (point_on(limb, before) - bones->meeting).norm() + (point_on(limb, after) - bones->meeting).norm();
    return {end - after, end - before, bones->bent * std::max(Scalar(0), way - (after - before)), bones->bent};
}

} // namespace skelgen::refinement
