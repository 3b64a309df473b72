#pragma once

#include <skelgen/curve/attachment.hpp>

#include <algorithm>
#include <utility>

#include <skelgen/core/geometry.hpp>
#include <skelgen/core/polyline.hpp>
#include <skelgen/curve/branch_sections.hpp>

namespace skelgen::curve {
namespace detail {

/// How far off its section's centre a point is, relative to the section's thickness.
template <typename Scalar>
Scalar off_centre(const BranchSection<Scalar>& section, const Vector3<Scalar>& place) {
    constexpr auto outside = Scalar(10); // no way leads there that there is another one for
    if (!section.encloses || !(section.thickness > 0)) return outside;
    return (section.centre - place).norm() / section.thickness;
}

/// The same summed over a line's length.
template <typename Scalar>
Scalar off_centre_along(const Body<Scalar>& body, const Points<Scalar>& line, Scalar spacing) {
    const std::vector<BranchSection<Scalar>> sections = sections_across(body, line, 4 * spacing);
    Scalar sum = 0;
    for (Eigen::Index i = 1; i + 1 < line.rows(); ++i)
        sum += off_centre(sections[static_cast<std::size_t>(i)], core::point(line, i)) *
               (core::point(line, i + 1) - core::point(line, i - 1)).norm() / 2;
    return sum;
}

/// A point of the curve: that of a branch's line.
struct CurvePlace {
    std::size_t branch;
    Eigen::Index point;
};

/// Makes a point of a branch's line a knot, and returns it; the second part is a new branch.
template <typename Scalar>
int make_knot(BranchedCurve<Scalar>& curve, const CurvePlace& place) {
    Branch<Scalar>& branch = curve.branches[place.branch];
    if (place.point == 0) return branch.from;
    if (place.point == branch.line.rows() - 1) return branch.to;
    const auto knot = static_cast<int>(curve.knots.size());
    curve.knots.push_back(core::point(branch.line, place.point));
    Branch<Scalar> rest{knot, branch.to, branch.line.bottomRows(branch.line.rows() - place.point), branch.origins};
    branch.to = knot;
    branch.line = branch.line.topRows(place.point + 1).eval();
    curve.branches.push_back(std::move(rest));
    return knot;
}

/// The straight line from one point to another, evenly spaced.
template <typename Scalar>
Points<Scalar> straight_line(const Vector3<Scalar>& from, const Vector3<Scalar>& to, Scalar spacing) {
    Points<Scalar> line(2, 3);
    line.row(0) = from.transpose();
    line.row(1) = to.transpose();
    return core::resample(line, std::min(spacing, (to - from).norm() / 2));
}

/// The first point from the line's start on where it runs in its own sections' middle, and over some points.
template <typename Scalar>
Eigen::Index own_from(const Points<Scalar>& line, const std::vector<BranchSection<Scalar>>& sections) {
    constexpr auto centred = Scalar(0.25);
    constexpr int in_a_row = 3;
    int found = 0;
    for (Eigen::Index i = 1; i + 1 < line.rows(); ++i) {
        found = off_centre(sections[static_cast<std::size_t>(i)], core::point(line, i)) < centred ? found + 1 : 0;
        if (found == in_a_row) return i - in_a_row + 1;
    }
    return line.rows() - 1;
}

/// Of the other branches' points every second one is tried, or so many in all where there are more.
inline constexpr Eigen::Index stride = 2, most_tries = 200;

/// The branch seen from its knot, joined where that is best; whether it has been moved.
template <typename Scalar>
bool reattach(BranchedCurve<Scalar>& curve, std::size_t index, bool at_end, const Body<Scalar>& body, Scalar spacing) {
    Branch<Scalar> branch = at_end ? turned(curve.branches[index]) : curve.branches[index];
    const int knot = branch.from;
    if (branch.from == branch.to) return false;
    const Eigen::Index own = own_from(branch.line, sections_across(body, branch.line, 4 * spacing));
    if (own < 2 || own + 1 >= branch.line.rows()) return false;
    const Vector3<Scalar> start = core::point(branch.line, own);
    const auto arc = core::arc_lengths(branch.line);
    const Scalar reach = Scalar(1.5) * arc[own] + 2 * spacing;
    Scalar least = Scalar(0.9) * off_centre_along<Scalar>(body, branch.line.topRows(own + 1), spacing);
    bool found = false;
    CurvePlace best{};
    Eigen::Index near = 0;
    for (const Branch<Scalar>& other : curve.branches)
        if (other.from == knot || other.to == knot) near += other.line.rows();
    const Eigen::Index step = std::max(stride, near / most_tries);
    const std::vector<int> degrees = curve.degrees();
    const auto is_end = [&](int k) { return degrees[static_cast<std::size_t>(k)] == 1; };
    for (std::size_t b = 0; b < curve.branches.size(); ++b) {
        const Branch<Scalar>& other = curve.branches[b];
        if (b == index || other.from == other.to || (other.from != knot && other.to != knot)) continue;
        const Points<Scalar>& line = other.line;
        for (Eigen::Index i = 0; i < line.rows(); i += step) {
            if ((i == 0 && is_end(other.from)) || (i + 1 == line.rows() && is_end(other.to))) continue;
            const Vector3<Scalar> target = core::point(line, i);
            if ((target - core::point(branch.line, 0)).norm() > reach) continue;
            if ((target - start).norm() < spacing) continue;
            const Scalar sum = off_centre_along(body, straight_line(target, start, spacing), spacing);
            if (!(sum < least)) continue;
            least = sum;
            found = true;
            best = {b, i};
        }
    }
    if (!found) return false;
    const Branch<Scalar>& chosen = curve.branches[best.branch];
    if ((best.point == 0 ? chosen.from : best.point == chosen.line.rows() - 1 ? chosen.to : -1) == branch.to)
        return false;
    const Points<Scalar> way = straight_line(core::point(chosen.line, best.point), start, spacing);
    const int joint = make_knot(curve, best);
    const Eigen::Index rest = branch.line.rows() - own;
    Points<Scalar> line(way.rows() + rest - 1, 3);
    line << way, branch.line.bottomRows(rest - 1);
    branch.from = joint;
    branch.line = std::move(line);
    curve.branches[index] = std::move(branch);
    if (curve.degrees()[static_cast<std::size_t>(knot)] == 2) curve = without_knot(std::move(curve), knot);
    return true;
}

} // namespace detail

template <typename Scalar>
BranchedCurve<Scalar> reattach_branches(BranchedCurve<Scalar> branched, const Body<Scalar>& body,
                                        std::type_identity_t<Scalar> spacing) {
    for (std::size_t b = 0; b < branched.branches.size(); ++b)
        for (const bool at_end : {false, true}) {
            if (b >= branched.branches.size()) break;
            const Branch<Scalar>& branch = branched.branches[b];
            if (branched.degrees()[static_cast<std::size_t>(at_end ? branch.to : branch.from)] < 3) continue;
            static_cast<void>(detail::reattach(branched, b, at_end, body, spacing));
        }
    return branched;
}

} // namespace skelgen::curve
