#pragma once

#include <skelgen/refinement/pelvis.hpp>

#include <algorithm>
#include <cstddef>
#include <vector>

#include <skelgen/core/line.hpp>
#include <skelgen/core/polyline.hpp>
#include <skelgen/refinement/centreline.hpp>
#include <skelgen/refinement/profile_matcher.hpp>

namespace skelgen::refinement {
namespace detail {

/// The sections that tell the trunk's axis, from and to this height above the fork, in thighs: lower, they hold
/// buttocks and the tops of the thighs, higher, the spine bends.
template <typename Scalar>
inline constexpr Scalar lowest_axis_section = Scalar(0.35);
template <typename Scalar>
inline constexpr Scalar highest_axis_section = Scalar(0.6);

/// By how much more they may be moved up, in thighs: to the ribs.
template <typename Scalar>
inline constexpr Scalar most_axis_lift = Scalar(0.4);

/// Sections this many times larger than the trunk's smallest hold a thigh, too: people's own hips are up to half as
/// large again as their waists.
template <typename Scalar>
inline constexpr Scalar thigh_in_section = Scalar(1.6);

/// Where the smallest one is looked for, in thighs from the fork along the line.
template <typename Scalar>
inline constexpr Scalar lowest_waist = Scalar(0.3);
template <typename Scalar>
inline constexpr Scalar highest_waist = Scalar(1);

/// A trunk's line is drawn coarsely, and recentred often: it begins as a rough guess, at its surface.
inline constexpr CentrelineOptions trunk_line_options{0.026, 4, 1.0};

} // namespace detail

template <typename Scalar>
std::optional<TrunkAxis<Scalar>> find_trunk_axis(const Slicer<Scalar>& slicer, const Points<Scalar>& line,
                                                 Scalar thigh) {
    using namespace detail;
    constexpr int samples = 6, rounds = 8;
    const Centreline<Scalar> trunk = draw_centreline(slicer, line, trunk_line_options);
    Scalar waist = 0;
    for (Eigen::Index i = 0; i < trunk.arc.size(); ++i) {
        if (trunk.arc[i] < lowest_waist<Scalar> * thigh || trunk.arc[i] > highest_waist<Scalar> * thigh) continue;
        if (trunk.area[i] > 0 && (!(waist > 0) || trunk.area[i] < waist)) waist = trunk.area[i];
    }
    if (!(waist > 0)) return std::nullopt;
    const Scalar middle = Scalar(0.5) * (lowest_axis_section<Scalar> + highest_axis_section<Scalar>)*thigh;
    const Scalar half = Scalar(0.5) * (highest_axis_section<Scalar> - lowest_axis_section<Scalar>)*thigh;
    const auto sample_arc = [&](Scalar centre, int i) {
        return centre + half * (2 * static_cast<Scalar>(i) / Scalar(samples - 1) - 1);
    };
    const auto undisturbed = [&](Scalar centre) {
        for (int i = 0; i < samples; ++i)
            if (core::value_at(trunk.area, trunk.arc, sample_arc(centre, i)) > thigh_in_section<Scalar> * waist)
                return false;
        return true;
    };
    TrunkAxis<Scalar> axis{Vector3<Scalar>::Zero(), Vector3<Scalar>::Zero(), line.row(0).transpose()};
    Scalar longer = 0; // than its height is the line up to the middle of the sections
    for (int round = 0; round < rounds; ++round) {
        Scalar lift = 0;
        while (lift < most_axis_lift<Scalar> * thigh && !undisturbed(middle + longer + lift))
            lift += Scalar(0.1) * half;
        std::vector<Vector3<Scalar>> centres;
        for (int i = 0; i < samples; ++i)
            centres.push_back(core::point_at(trunk.points, trunk.arc, sample_arc(middle + longer + lift, i)));
        const core::Line<Scalar> fitted = core::principal_line(centres);
        axis.place = fitted.point;
        axis.up = fitted.direction;
        longer += Scalar(0.5) * (middle + lift - (axis.place - axis.fork).dot(axis.up));
    }
    return axis;
}

namespace detail {

/// How much a leg says that `ahead` is where the body faces: its foot and its thigh point there, or away. -2 to 2.
template <typename Scalar>
Scalar facing(const Placement<Scalar>& placement, const Limb<Scalar>& leg, const Vector3<Scalar>& ahead) {
    const Vector3<Scalar> thigh = placement.at(leg.joints[1]) - placement.at(leg.joints[0]);
    Scalar out = thigh.normalized().dot(ahead);
    if (leg.missing > 0) return out;
    if (const auto ankle = find_in_limb(leg, placement.skeleton_template(), JointRole::ankle))
        out += (tip_of(leg) - placement.at(leg.joints[*ankle])).normalized().dot(ahead);
    return out;
}

/// How far below `axis.place` along `up` the hips lie: what the fork and the lengths of the thighs together make
/// likely (least squares; the fork with a Cauchy weight). `to_hip`: from between the hips to that of the first leg.
template <typename Scalar>
Scalar hips_below(const Placement<Scalar>& placement, const std::vector<const Limb<Scalar>*>& legs,
                  const TrunkAxis<Scalar>& axis, const Vector3<Scalar>& up, const Vector3<Scalar>& to_hip,
                  const PelvisOptions& options) {
    constexpr int rounds = 10; // of Gauss-Newton, reweighted: it settles within them
    const Scalar thigh = placement.rest_distance(legs[0]->joints[0], legs[0]->joints[1]);
    const auto precision = [&](double deviation) {
        const Scalar length = static_cast<Scalar>(deviation) * thigh;
        return 1 / (length * length);
    };
    const Scalar by_fork = (axis.place - axis.fork).dot(up) - static_cast<Scalar>(options.hips_above_fork) * thigh;
    Scalar below = by_fork;
    for (int round = 0; round < rounds; ++round) {
        // Far from where the thighs' lengths put the hips, it is rather the hem of a coat than the fork of the legs.
        const Scalar off = below - by_fork, fork = precision(options.fork_deviation);
        const Scalar weight = fork / (1 + fork * off * off / static_cast<Scalar>(far_off));
        Scalar gradient = weight * off, curvature = weight;
        for (const Limb<Scalar>* leg : legs) {
            const Vector3<Scalar> side = leg == legs.front() ? to_hip : Vector3<Scalar>(-to_hip);
            const Vector3<Scalar> bone = axis.place - below * up + side - placement.at(leg->joints[1]);
            const Scalar slope = -bone.normalized().dot(up); // of the bone's length
            const Scalar longer = bone.norm() - (leg->from_tip[0] - leg->from_tip[1]);
            gradient += precision(options.thigh_deviation) * longer * slope;
            curvature += precision(options.thigh_deviation) * slope * slope;
        }
        below -= gradient / curvature;
    }
    return below;
}

/// Hips whose line is nearer to the axis than this part of it (a cosine) are not those of one pelvis.
template <typename Scalar>
inline constexpr Scalar least_level = Scalar(0.3);

} // namespace detail

template <typename Scalar>
std::optional<Placement<Scalar>> place_pelvis(Placement<Scalar> placement, const std::vector<Limb<Scalar>>& limbs,
                                              const TrunkAxis<Scalar>& axis, const PelvisOptions& options) {
    std::vector<const Limb<Scalar>*> legs;
    for (const std::size_t leg : find_legs(limbs, placement.skeleton_template())) legs.push_back(&limbs[leg]);
    if (legs.empty()) return std::nullopt;
    const int one = legs[0]->joints[0], other = legs[1]->joints[0];
    const Vector3<Scalar> between = placement.at(one) - placement.at(other);
    const Vector3<Scalar> level = between - between.dot(axis.up) * axis.up;
    if (!(level.norm() > detail::least_level<Scalar> * between.norm())) return std::nullopt;
    const Vector3<Scalar> to_hip = Scalar(0.5) * between.norm() * level.normalized();

    const Vector3<Scalar> ahead = level.normalized().cross(axis.up);
    const Scalar faces = detail::facing(placement, *legs[0], ahead) + detail::facing(placement, *legs[1], ahead);
    const Scalar tilt = static_cast<Scalar>(options.tilt) * std::clamp(faces, Scalar(-1), Scalar(1));
    const Vector3<Scalar> up = (axis.up - tilt * ahead).normalized();
    const Vector3<Scalar> middle = axis.place - detail::hips_below(placement, legs, axis, up, to_hip, options) * up;
    placement.put(one, middle + to_hip);
    placement.put(other, middle - to_hip);
    const int root = placement.find(JointRole::pelvis);
    const double higher =
        placement.skeleton_template().joint(root).position.y() - placement.rest_height(JointRole::hip);
    placement.put(root, middle + placement.scale() * static_cast<Scalar>(higher) * up);
    return placement;
}

} // namespace skelgen::refinement
