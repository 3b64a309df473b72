#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include <skelgen/core/geometry.hpp>
#include <skelgen/core/polyline.hpp>
#include <skelgen/curve/branch_sections.hpp>
#include <skelgen/curve/branched_curve.hpp>
#include <skelgen/surface/body.hpp>

namespace skelgen::curve {

namespace detail {

/// Ends lie inside by this part of the last straight piece.
template <typename Scalar>
inline constexpr Scalar end_depth = Scalar(0.02);

/// The cap of a limb reaches out this many thicknesses at most.
template <typename Scalar>
inline constexpr Scalar longest_cap = Scalar(4);

/// Thickness of a limb where its cap begins, seen from its end: of the first section that is as far from the end as it
/// is thick; 0 when there is none. `backwards`: the sections begin at the other end.
template <typename Scalar>
Scalar cap_thickness(const Eigen::Matrix<Scalar, Eigen::Dynamic, 1>& arc,
                     const std::vector<BranchSection<Scalar>>& sections, bool backwards) {
    constexpr auto doubtful = Scalar(0.3);
    for (std::size_t i = 1; i + 1 < sections.size(); ++i) {
        const BranchSection<Scalar>& section = sections[backwards ? sections.size() - 1 - i : i];
        const Scalar from_end = arc[static_cast<Eigen::Index>(i)];
        if (section.weight > doubtful && from_end >= section.thickness) return section.thickness;
    }
    return 0;
}

/// A line that begins at its end, with its sections, that are in the order of the line or the other way round.
template <typename Scalar>
Points<Scalar> with_end_on_axis(const Points<Scalar>& line, const std::vector<BranchSection<Scalar>>& sections,
                                bool backwards, const Body<Scalar>& body) {
    const auto arc = core::arc_lengths(line);
    const Scalar length = arc[arc.size() - 1], cap = cap_thickness(arc, sections, backwards);
    if (!(cap > 0)) return line;
    const Scalar stand = std::min(cap, length / 2), behind = std::min(stand + cap, length);
    const Vector3<Scalar> place = core::point_at(line, arc, stand);
    const Vector3<Scalar> direction = (place - core::point_at(line, arc, behind)).normalized();
    const Scalar reach = body.tree.first_along(body.mesh, place, direction).distance;
    if (!(reach <= longest_cap<Scalar> * cap)) return line;
    Points<Scalar> out = line;
    const Scalar straight = (1 - end_depth<Scalar>)*reach, total = length - stand + straight;
    for (Eigen::Index i = 0; i < line.rows(); ++i) {
        const Scalar from_place = straight - total * static_cast<Scalar>(i) / static_cast<Scalar>(line.rows() - 1);
        core::set_point(out, i,
                        Vector3<Scalar>(from_place > 0 ? place + from_place * direction
                                                       : core::point_at(line, arc, stand - from_place)));
    }
    return out;
}

template <typename Scalar>
Points<Scalar> reversed(const Points<Scalar>& line) {
    return line.colwise().reverse();
}

} // namespace detail

/// Ends where the axes of their branches leave the surface: over the cap of a limb, which is as long as the limb is
/// thick before it, the branch goes on straight, up to just inside the surface. A branch whose sections do not say
/// where its cap begins stays as it is. `sections` as of the lines before they were moved. O(k) and a ray for each end.
template <typename Scalar>
BranchedCurve<Scalar> ends_on_axes(BranchedCurve<Scalar> branched,
                                   const std::vector<std::vector<BranchSection<Scalar>>>& sections,
                                   const Body<Scalar>& body) {
    const std::vector<int> degrees = branched.degrees();
    const auto is_end = [&](int knot) { return degrees[static_cast<std::size_t>(knot)] == 1; };
    for (std::size_t b = 0; b < branched.branches.size(); ++b) {
        Branch<Scalar>& branch = branched.branches[b];
        if (is_end(branch.from)) {
            branch.line = detail::with_end_on_axis(branch.line, sections[b], false, body);
            branched.knots[static_cast<std::size_t>(branch.from)] = core::point(branch.line, 0);
        }
        if (is_end(branch.to)) {
            branch.line =
                detail::reversed(detail::with_end_on_axis(detail::reversed(branch.line), sections[b], true, body));
            branched.knots[static_cast<std::size_t>(branch.to)] = core::point(branch.line, branch.line.rows() - 1);
        }
    }
    return branched;
}

} // namespace skelgen::curve
