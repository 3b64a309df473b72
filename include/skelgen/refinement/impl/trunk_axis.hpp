#pragma once

#include <skelgen/refinement/trunk_axis.hpp>

#include <vector>

#include <Eigen/Eigenvalues>

#include <skelgen/core/geometry.hpp>
#include <skelgen/core/line.hpp>
#include <skelgen/core/polyline.hpp>
#include <skelgen/refinement/centreline.hpp>

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

/// Area of the trunk's smallest section; 0 where it shows none.
template <typename Scalar>
Scalar waist_area(const Centreline<Scalar>& trunk, Scalar thigh) {
    Scalar waist = 0;
    for (Eigen::Index i = 0; i < trunk.arc.size(); ++i) {
        if (trunk.arc[i] < lowest_waist<Scalar> * thigh || trunk.arc[i] > highest_waist<Scalar> * thigh) continue;
        if (trunk.area[i] > 0 && (!(waist > 0) || trunk.area[i] < waist)) waist = trunk.area[i];
    }
    return waist;
}

/// Along which sections across `axis` are widest, as `TrunkAxis::across`: from its place up by a fifth of a thigh,
/// those without a thigh.
template <typename Scalar>
Vector3<Scalar> across_sections(const Slicer<Scalar>& slicer, const TrunkAxis<Scalar>& axis, Scalar thigh,
                                Scalar waist) {
    constexpr int samples = 5;
    Eigen::Matrix3<Scalar> sum = Eigen::Matrix3<Scalar>::Zero();
    int count = 0;
    for (int i = 0; i < samples; ++i) {
        const Scalar height = Scalar(0.2) * thigh * static_cast<Scalar>(i) / Scalar(samples - 1);
        const auto section = slicer.around(axis.place + height * axis.up, axis.up, Scalar(0.1) * thigh);
        if (!section || section->area > thigh_in_section<Scalar> * waist) continue;
        const Vector3<Scalar> widest = widest_direction(*section);
        if (widest.norm() > 0) core::add_outer_product<Scalar>(sum, 1 / widest.norm(), widest);
        ++count;
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3<Scalar>> axes(sum);
    if (count == 0) return Vector3<Scalar>::Zero();
    // Sections that are widest along different ways say as little as round ones.
    return (axes.eigenvalues()[2] - axes.eigenvalues()[1]) / static_cast<Scalar>(count) * axes.eigenvectors().col(2);
}

} // namespace detail

template <typename Scalar>
std::optional<TrunkAxis<Scalar>> find_trunk_axis(const Slicer<Scalar>& slicer, const Points<Scalar>& line,
                                                 Scalar thigh) {
    using namespace detail;
    constexpr int samples = 6, rounds = 8;
    const Centreline<Scalar> trunk = draw_centreline(slicer, line, trunk_line_options);
    const Scalar waist = waist_area(trunk, thigh);
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
        const core::FittedLine<Scalar> fitted = core::principal_line(centres);
        axis.place = fitted.point;
        axis.up = fitted.direction;
        longer += Scalar(0.5) * (middle + lift - (axis.place - axis.fork).dot(axis.up));
    }
    axis.across = across_sections(slicer, axis, thigh, waist);
    axis.largest_section = thigh_in_section<Scalar> * waist;
    return axis;
}

} // namespace skelgen::refinement
