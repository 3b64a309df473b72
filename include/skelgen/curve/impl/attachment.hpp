#pragma once

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <skelgen/core/geometry.hpp>
#include <skelgen/core/polyline.hpp>
#include <skelgen/curve/branch_sections.hpp>
#include <skelgen/curve/branched_curve.hpp>
#include <skelgen/surface/body.hpp>

namespace skelgen::curve {

namespace detail {

/// How far off their sections' centres a line's points are, summed over its length; where that is no less than
/// `enough`, something that is no less either.
template <typename Scalar>
Scalar off_centre_along(const Body<Scalar>& body, const Points<Scalar>& line, Scalar spacing,
                        Scalar enough = std::numeric_limits<Scalar>::infinity()) {
    Scalar sum = 0;
    for (Eigen::Index i = 1; i + 1 < line.rows() && sum < enough; ++i)
        sum += off_centre(section_across(body, line, i, reach_in_spacings * spacing), core::point(line, i)) *
               (core::point(line, i + 1) - core::point(line, i - 1)).norm() / 2;
    return sum;
}

/// A point of the curve: that of a branch's line.
struct CurvePlace {
    std::size_t branch;
    Eigen::Index point;
};

/// A curve with a knot at one of its points.
template <typename Scalar>
struct KnottedCurve {
    BranchedCurve<Scalar> curve;
    int knot;
};

/// The curve with a knot at that point; where there was none, the second part of the branch is a new one.
template <typename Scalar>
KnottedCurve<Scalar> with_knot(BranchedCurve<Scalar> curve, const CurvePlace& place) {
    Branch<Scalar>& branch = curve.branches[place.branch];
    if (place.point == 0) return {curve, branch.from};
    if (place.point == branch.line.rows() - 1) return {curve, branch.to};
    const auto knot = static_cast<int>(curve.knots.size());
    curve.knots.push_back(core::point(branch.line, place.point));
    Branch<Scalar> rest{knot, branch.to, branch.line.bottomRows(branch.line.rows() - place.point), branch.origins};
    branch.to = knot;
    branch.line = branch.line.topRows(place.point + 1).eval();
    curve.branches.push_back(std::move(rest));
    return {std::move(curve), knot};
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
Eigen::Index own_from(const Body<Scalar>& body, const Points<Scalar>& line, Scalar spacing) {
    constexpr auto centred = Scalar(0.25);
    constexpr int in_a_row = 3;
    int found = 0;
    for (Eigen::Index i = 1; i + 1 < line.rows(); ++i) {
        const BranchSection<Scalar> section = section_across(body, line, i, reach_in_spacings * spacing);
        found = off_centre(section, core::point(line, i)) < centred ? found + 1 : 0;
        if (found == in_a_row) return i - in_a_row + 1;
    }
    return line.rows() - 1;
}

/// Of the other branches' points every second one is tried, or so many in all where there are more.
inline constexpr Eigen::Index stride = 2, most_tries = 200;

/// A place is looked for as far from the knot as this many times the way to the branch's own sections.
template <typename Scalar>
inline constexpr Scalar furthest_move = Scalar(1.5);

/// Another way has to be better than the one that is there by this factor.
template <typename Scalar>
inline constexpr Scalar clearly_better = Scalar(0.9);

/// The points of other branches to which the branch could be joined instead of to its knot: those at the same knot, as
/// far as `reach` from it, but for ends.
template <typename Scalar>
std::vector<CurvePlace> places_near(const BranchedCurve<Scalar>& curve, std::size_t index, int knot, Scalar reach) {
    const auto is_candidate = [&](std::size_t b) {
        const Branch<Scalar>& other = curve.branches[b];
        return b != index && other.from != other.to && (other.from == knot || other.to == knot);
    };
    Eigen::Index points = 0;
    for (std::size_t b = 0; b < curve.branches.size(); ++b)
        if (is_candidate(b)) points += curve.branches[b].line.rows();
    const Eigen::Index step = std::max(stride, points / most_tries);
    const std::vector<int> degrees = curve.degrees();
    const auto is_end = [&](int k) { return degrees[static_cast<std::size_t>(k)] == 1; };
    std::vector<CurvePlace> out;
    for (std::size_t b = 0; b < curve.branches.size(); ++b) {
        if (!is_candidate(b)) continue;
        const Branch<Scalar>& other = curve.branches[b];
        for (Eigen::Index i = 0; i < other.line.rows(); i += step) {
            if ((i == 0 && is_end(other.from)) || (i + 1 == other.line.rows() && is_end(other.to))) continue;
            const Vector3<Scalar> place = core::point(other.line, i);
            if ((place - curve.knots[static_cast<std::size_t>(knot)]).norm() <= reach) out.push_back({b, i});
        }
    }
    return out;
}

/// Where the straight way to `start` is best centred, and clearly better than `now`, that of the way that is there.
template <typename Scalar>
std::optional<CurvePlace> best_place(const BranchedCurve<Scalar>& curve, const std::vector<CurvePlace>& places,
                                     const Vector3<Scalar>& start, Scalar now, const Body<Scalar>& body,
                                     Scalar spacing) {
    std::optional<CurvePlace> best;
    Scalar least = clearly_better<Scalar> * now;
    for (const CurvePlace& place : places) {
        const Vector3<Scalar> target = core::point(curve.branches[place.branch].line, place.point);
        if ((target - start).norm() < spacing) continue;
        const Scalar sum = off_centre_along(body, straight_line(target, start, spacing), spacing, least);
        if (!(sum < least)) continue;
        least = sum;
        best = place;
    }
    return best;
}

/// The branch, seen from its knot, joined to that point instead, by a straight way from its point `own` on.
template <typename Scalar>
BranchedCurve<Scalar> rejoined(BranchedCurve<Scalar> curve, std::size_t index, Branch<Scalar> branch, Eigen::Index own,
                               const CurvePlace& place, Scalar spacing) {
    const int left = branch.from;
    KnottedCurve<Scalar> knotted = with_knot(std::move(curve), place);
    curve = std::move(knotted.curve);
    const Vector3<Scalar> target = curve.knots[static_cast<std::size_t>(knotted.knot)];
    const Points<Scalar> way = straight_line<Scalar>(target, core::point(branch.line, own), spacing);
    const Eigen::Index rest = branch.line.rows() - own;
    Points<Scalar> line(way.rows() + rest - 1, 3);
    line << way, branch.line.bottomRows(rest - 1);
    branch.from = knotted.knot;
    branch.line = std::move(line);
    curve.branches[index] = std::move(branch);
    return curve.degrees()[static_cast<std::size_t>(left)] == 2 ? without_knot(std::move(curve), left) : curve;
}

/// The branch, seen from one of its knots, joined where that is best.
template <typename Scalar>
BranchedCurve<Scalar> reattached(BranchedCurve<Scalar> curve, std::size_t index, bool at_end, const Body<Scalar>& body,
                                 Scalar spacing) {
    const Branch<Scalar> branch = at_end ? turned(curve.branches[index]) : curve.branches[index];
    if (branch.from == branch.to) return curve;
    const Points<Scalar>& line = branch.line;
    const Eigen::Index own = own_from(body, line, spacing);
    if (own < 2 || own + 1 >= line.rows()) return curve;
    const Scalar away = core::arc_lengths(line)[own];

    const Scalar reach = furthest_move<Scalar> * away + 2 * spacing;
    const Scalar now = off_centre_along<Scalar>(body, line.topRows(own + 1), spacing);
    const auto place = best_place<Scalar>(curve, places_near(curve, index, branch.from, reach), core::point(line, own),
                                          now, body, spacing);
    if (!place) return curve;
    const Branch<Scalar>& chosen = curve.branches[place->branch];
    const bool ends_there = (place->point == 0 && chosen.from == branch.to) ||
                            (place->point == chosen.line.rows() - 1 && chosen.to == branch.to);
    return ends_there ? curve : rejoined(std::move(curve), index, branch, own, *place, spacing);
}

} // namespace detail

/// Each branch joined to the others where the way there is best centred: from where its own sections begin, it goes
/// straight to that point of the branches at its junction, not much farther from the junction than the branch lies in
/// them, to which the sections across the way are least off their centres, summed over its length. The way that it has
/// stays if it is about as good, or if the axes meet at its junction. Junctions that are left by all but two branches
/// go. \param meetings per knot, the place where axes meet, as meeting_axes() finds it. \param spacing of the lines'
/// points. O(branches k) sections.
template <typename Scalar>
BranchedCurve<Scalar> reattach_branches(BranchedCurve<Scalar> branched, const PlacesOfKnots<Scalar>& meetings,
                                        const Body<Scalar>& body, std::type_identity_t<Scalar> spacing) {
    const auto stays = [&](int knot) { // at a junction that was not there at first, nothing is known to meet
        const auto k = static_cast<std::size_t>(knot);
        return branched.degrees()[k] < 3 || (k < meetings.size() && meetings[k]);
    };
    for (std::size_t b = 0; b < branched.branches.size(); ++b)
        for (const bool at_end : {false, true}) {
            if (b >= branched.branches.size()) break;
            const Branch<Scalar>& branch = branched.branches[b];
            if (stays(at_end ? branch.to : branch.from)) continue;
            branched = detail::reattached(std::move(branched), b, at_end, body, spacing);
        }
    return branched;
}

} // namespace skelgen::curve
