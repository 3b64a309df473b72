#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include <skelgen/core/mesh.hpp>
#include <skelgen/core/skeleton_template.hpp>
#include <skelgen/refinement/bone_line.hpp>
#include <skelgen/refinement/limbs.hpp>

namespace skelgen::refinement {

namespace detail {

/// An upper arm's own thickness is that of its sections from here to there, as parts of it from the elbow on: above
/// what folds at an elbow, below the armpit. Working values.
template <typename Scalar>
inline constexpr std::pair<Scalar, Scalar> own_thickness{Scalar(0.2), Scalar(0.45)};

/// Where it is so much thicker the armpit begins. Of 1.1 to 2 what lies nearest to equally far from the shoulder on 86
/// bodies, registered and landmarked; the next three are calibrated on the same ones.
template <typename Scalar>
inline constexpr Scalar armpit_growth = Scalar(1.15);

/// How far the shoulder lies beyond that, of the upper arm, when it is held at right angles to the trunk.
template <typename Scalar>
inline constexpr Scalar shoulder_beyond_armpit = Scalar(0.33);

/// How much less that is for an arm that points upwards, and more for one that hangs.
template <typename Scalar>
inline constexpr Scalar nearer_when_raised = Scalar(0.05);

/// Standard deviation of it, of the upper arm.
template <typename Scalar>
inline constexpr Scalar armpit_deviation = Scalar(0.09);

/// Does the limb begin with an upper arm?
template <typename Scalar>
bool has_upper_arm(const Limb<Scalar>& limb, const SkeletonTemplate& skeleton_template) {
    return limb.joints.size() > 1 && skeleton_template.joint(limb.joints[0]).role == JointRole::shoulder &&
           skeleton_template.joint(limb.joints[1]).role == JointRole::elbow;
}

/// Arc length where, looked at from the elbow, an upper arm becomes thicker than `most`, between its sections; none
/// where it does not.
template <typename Scalar>
std::optional<Scalar> becomes_thicker(const Limb<Scalar>& limb, Scalar most) {
    const Centreline<Scalar>& line = limb.line;
    const Scalar last_own = arc_of(limb, 1) - own_thickness<Scalar>.second * (limb.from_tip[0] - limb.from_tip[1]);
    for (Eigen::Index i = line.arc.size() - 1; i-- > 0;) {
        if (line.arc[i] > last_own || !(line.thickness[i] > most)) continue;
        const Scalar here = line.thickness[i], before = line.thickness[i + 1];
        const bool is_between = before > 0 && before < most;
        const Scalar part = is_between ? (most - before) / (here - before) : Scalar(0);
        return line.arc[i + 1] + part * (line.arc[i] - line.arc[i + 1]);
    }
    return std::nullopt;
}

} // namespace detail

/// Median thickness of an upper arm's own sections, between elbow and armpit; none with fewer than three of them. The
/// limb must have two joints. O(sections).
template <typename Scalar>
std::optional<Scalar> upper_arm_thickness(const Limb<Scalar>& limb) {
    constexpr std::size_t fewest = 3;
    const auto [from, to] = detail::own_thickness<Scalar>;
    const Scalar elbow = arc_of(limb, 1), upper = elbow - arc_of(limb, 0);
    std::vector<Scalar> own;
    for (Eigen::Index i = 0; i < limb.line.arc.size(); ++i) {
        const Scalar along = (elbow - limb.line.arc[i]) / upper;
        if (along >= from && along <= to && limb.line.thickness[i] > 0) own.push_back(limb.line.thickness[i]);
    }
    if (own.size() < fewest) return std::nullopt;
    const auto middle = own.begin() + static_cast<std::ptrdiff_t>(own.size() / 2);
    std::nth_element(own.begin(), middle, own.end());
    return *middle;
}

/// The limbs with `top_by_trunk` and `top_deviation` of the arms set: an upper arm is as thick all along, and grows
/// where the armpit begins, a third of its length before the shoulder; raised, the skin goes along, and it begins
/// nearer. `trunk_up`: from the fork of the legs to the head, a unit vector; without it arms count as held level. Left
/// unset where an arm shows too little of its own, or does not grow. O(sections).
template <typename Scalar>
std::vector<Limb<Scalar>>
anchor_shoulders(std::vector<Limb<Scalar>> limbs, const std::optional<Vector3<Scalar>>& trunk_up,
                 const SkeletonTemplate& skeleton_template, const BoneLineOptions& options = {}) {
    for (Limb<Scalar>& limb : limbs) {
        if (!detail::has_upper_arm(limb, skeleton_template)) continue;
        const auto thickness = upper_arm_thickness(limb);
        if (!thickness) continue;
        const auto armpit = detail::becomes_thicker(limb, detail::armpit_growth<Scalar> * *thickness);
        if (!armpit) continue;
        const auto line = fit_first_bone(limb, options);
        const Scalar raised = line && trunk_up ? line->direction.dot(*trunk_up) : Scalar(0);
        const Scalar upper = limb.from_tip[0] - limb.from_tip[1];
        const Scalar beyond = detail::shoulder_beyond_armpit<Scalar> - detail::nearer_when_raised<Scalar> * raised;
        limb.top_by_trunk = limb.line.arc[limb.line.arc.size() - 1] - *armpit + beyond * upper;
        limb.top_deviation = detail::armpit_deviation<Scalar> * upper;
    }
    return limbs;
}

} // namespace skelgen::refinement
