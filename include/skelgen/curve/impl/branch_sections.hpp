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

/// Points to both sides from which a tangent is taken.
inline constexpr Eigen::Index section_tangent_reach = 2;

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
BranchSection<Scalar> measured(surface::Contour<Scalar> contour, const Vector3<Scalar>& place,
                               const Vector3<Scalar>& tangent) {
    const std::size_t n = contour.points.size();
    const auto next = [&](std::size_t i) -> const Vector3<Scalar>& { return contour.points[i + 1 < n ? i + 1 : 0]; };
    BranchSection<Scalar> out;
    out.normal = tangent;
    Scalar length = 0;
    std::vector<Scalar> lengths(n); // of the segments
    for (std::size_t i = 0; i < n; ++i) {
        const Scalar l = lengths[i] = (next(i) - contour.points[i]).norm();
        out.centre += l / 2 * (contour.points[i] + next(i));
        length += l;
    }
    if (!(length > 0)) return {}; // a plane that touches a vertex
    out.centre /= length;
    Scalar from_centre = std::numeric_limits<Scalar>::infinity();
    for (std::size_t i = 0; i < n; ++i) {
        const Vector3<Scalar> middle = (contour.points[i] + next(i)) / 2;
        out.thickness += lengths[i] / length * (middle - out.centre).norm();
        from_centre = std::min(from_centre, (contour.points[i] - out.centre).squaredNorm());
    }
    from_centre = std::sqrt(from_centre);
    const surface::PlanarRelation<Scalar> relation = surface::relate(contour, place, tangent);
    out.encloses = relation.encloses;
    // Outside, being near the surface says nothing.
    const Scalar clearance =
        out.encloses ? std::max(relation.distance, flat_clearance<Scalar> * out.thickness) : out.thickness;
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
    const Vector3<Scalar> tangent = core::tangent_at(line, point, detail::section_tangent_reach);
    auto contour = surface::contour_around(body.mesh, body.adjacency, body.tree, place, tangent, reach);
    return contour ? detail::measured(*std::move(contour), place, tangent) : BranchSection<Scalar>{};
}

template <typename Scalar>
std::vector<BranchSection<Scalar>> sections_across(const Body<Scalar>& body, const Points<Scalar>& line,
                                                   std::type_identity_t<Scalar> reach) {
    std::vector<BranchSection<Scalar>> out(static_cast<std::size_t>(line.rows()));
    for (Eigen::Index i = 1; i + 1 < line.rows(); ++i)
        out[static_cast<std::size_t>(i)] = section_across(body, line, i, reach);
    return out;
}

} // namespace skelgen::curve
