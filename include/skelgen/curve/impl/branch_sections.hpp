#pragma once

#include <skelgen/curve/branch_sections.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include <skelgen/core/geometry.hpp>
#include <skelgen/core/polyline.hpp>

namespace skelgen::curve {
namespace detail {

/// A section whose centre is this much farther from the line than the nearest surface is half in doubt: it may be that
/// of the part that the branch runs into. Calibrated on generated tubes and bodies.
template <typename Scalar>
inline constexpr Scalar doubtful_shift = Scalar(1.2);

/// A section this much thicker than the ball at its centre is half in doubt, too: a limb and its trunk cut in one, or
/// two limbs. An ellipse of one to three has 1.9.
template <typename Scalar>
inline constexpr Scalar doubtful_spread = Scalar(2);

/// Flat sections have their surface near all along: it does not count as nearer than this part of their thickness.
template <typename Scalar>
inline constexpr Scalar flat_clearance = Scalar(0.3);

template <typename Scalar>
Scalar certainty(Scalar ratio) {
    const Scalar square = ratio * ratio;
    return 1 / (1 + square * square);
}

template <typename Scalar>
BranchSection<Scalar> measured(surface::ContourAround<Scalar> contour, const Vector3<Scalar>& place,
                               const Vector3<Scalar>& tangent) {
    const std::vector<Vector3<Scalar>>& points = contour.points;
    BranchSection<Scalar> out;
    out.normal = tangent;
    Scalar length = 0;
    std::vector<Scalar> lengths; // of the segments that end at each point
    lengths.reserve(points.size());
    const Vector3<Scalar>* before = &points.back();
    for (const Vector3<Scalar>& point : points) {
        const Scalar l = (point - *before).norm();
        lengths.push_back(l);
        out.centre += l * (*before + point);
        length += l;
        before = &point;
    }
    if (!(length > 0)) return {}; // a plane that touches a vertex
    out.centre /= 2 * length;
    Scalar from_centre = std::numeric_limits<Scalar>::infinity();
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Vector3<Scalar> middle = (*before + points[i]) / 2;
        out.thickness += lengths[i] * (middle - out.centre).norm();
        from_centre = std::min(from_centre, (points[i] - out.centre).squaredNorm());
        before = &points[i];
    }
    out.thickness /= length;
    from_centre = std::sqrt(from_centre);
    out.encloses = contour.relation.encloses;
    // Outside, being near the surface says nothing.
    const Scalar clearance =
        out.encloses ? std::max(contour.relation.distance, flat_clearance<Scalar> * out.thickness) : out.thickness;
    const Scalar shift = (out.centre - place).norm();
    out.weight = certainty(shift / (doubtful_shift<Scalar> * clearance)) *
                 certainty(out.thickness / (doubtful_spread<Scalar> * std::max(from_centre, out.thickness / 100)));
    out.contour = std::move(contour);
    return out;
}

} // namespace detail

template <typename Scalar>
BranchSection<Scalar> section_across(const Body<Scalar>& body, const Points<Scalar>& line, Eigen::Index point,
                                     std::type_identity_t<Scalar> reach) {
    const Vector3<Scalar> place = core::point(line, point);
    const Vector3<Scalar> tangent = core::tangent_at(line, point, section_tangent_reach);
    auto contour = surface::contour_around(body.mesh, body.adjacency, body.tree, place, tangent, reach);
    return contour ? detail::measured(*std::move(contour), place, tangent) : BranchSection<Scalar>{};
}

} // namespace skelgen::curve
