#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Cholesky>

#include <skelgen/core/geometry.hpp>
#include <skelgen/core/line.hpp>
#include <skelgen/core/polyline.hpp>
#include <skelgen/core/precision.hpp>
#include <skelgen/curve/branch_sections.hpp>
#include <skelgen/curve/branched_curve.hpp>
#include <skelgen/surface/body.hpp>

namespace skelgen::curve {

namespace detail {

// Lengths at a junction, in radii of the ball at its knot; calibrated on generated tubes, and on animals and bodies.
template <typename Scalar>
inline constexpr Scalar leaving = Scalar(4); ///< how far out a branch's direction is taken
template <typename Scalar>
inline constexpr Scalar shortest_beside = Scalar(1); ///< of the branches that others have to part from
template <typename Scalar>
inline constexpr Scalar parted = Scalar(1.2); ///< two tubes at right angles have parted at 1
template <typename Scalar>
inline constexpr Scalar latest_parting = Scalar(4.8); ///< however small the angle
template <typename Scalar>
inline constexpr Scalar axis_length = Scalar(1); ///< over which an axis is laid through sections' centres
template <typename Scalar>
inline constexpr Scalar longest_without_axis = Scalar(4); ///< a link between two junctions has no own sections
template <typename Scalar>
inline constexpr Scalar meeting_miss = Scalar(0.1); ///< how far off the place where they meet axes may pass
template <typename Scalar>
inline constexpr Scalar longest_move = Scalar(0.7); ///< of the knot to that place

/// Sections through whose centres an axis is laid, at least where there are so many.
inline constexpr std::size_t axis_sections = 4;

/// An end of a branch.
struct BranchEnd {
    std::size_t branch;
    bool at_end;
};

/// Per knot, the ends of branches that are there.
template <typename Scalar>
std::vector<std::vector<BranchEnd>> ends_at_knots(const BranchedCurve<Scalar>& curve) {
    std::vector<std::vector<BranchEnd>> out(curve.knots.size());
    for (std::size_t b = 0; b < curve.branches.size(); ++b) {
        out[static_cast<std::size_t>(curve.branches[b].from)].push_back({b, false});
        out[static_cast<std::size_t>(curve.branches[b].to)].push_back({b, true});
    }
    return out;
}

template <typename Scalar>
Scalar length_of(const Branch<Scalar>& branch) {
    return core::arc_lengths(branch.line)[branch.line.rows() - 1];
}

/// Unit vector from the branch's end to where it is so far along it.
template <typename Scalar>
Vector3<Scalar> direction_of(const Branch<Scalar>& branch, bool at_end, Scalar far) {
    const auto arc = core::arc_lengths(branch.line);
    const Scalar length = arc[arc.size() - 1], along = std::min(far, length);
    return (core::point_at(branch.line, arc, at_end ? length - along : along) -
            core::point(branch.line, at_end ? branch.line.rows() - 1 : 0))
        .normalized();
}

/// The axis of a branch where its own sections begin, `from` its end on; none where there are too few.
template <typename Scalar>
std::optional<core::FittedLine<Scalar>> axis_of(const Branch<Scalar>& branch,
                                                const std::vector<BranchSection<Scalar>>& sections, bool at_end,
                                                Scalar from, Scalar length) {
    const auto arc = core::arc_lengths(branch.line);
    std::vector<Vector3<Scalar>> centres;
    for (std::size_t i = 1; i + 1 < sections.size(); ++i) {
        const std::size_t k = at_end ? sections.size() - 1 - i : i;
        const Scalar there = arc[static_cast<Eigen::Index>(k)], away = at_end ? arc[arc.size() - 1] - there : there;
        if (away < from) continue;
        const bool is_own = !(sections[k].weight < sure_section<Scalar>);
        if (away > from + length && (!is_own || centres.size() >= axis_sections)) break;
        if (is_own) centres.push_back(sections[k].centre);
    }
    if (centres.size() < 3) return std::nullopt;
    return core::principal_line(centres);
}

/// The place from which the sum of the squared distances to the axes is least; along all of them, the one nearest to
/// `knot`.
template <typename Scalar>
Vector3<Scalar> nearest_place(const std::vector<core::FittedLine<Scalar>>& axes, const Vector3<Scalar>& knot) {
    using Matrix3 = Eigen::Matrix<Scalar, 3, 3>;
    constexpr auto held = Scalar(1e-3);
    Matrix3 matrix = held * Matrix3::Identity();
    Vector3<Scalar> right = held * knot;
    for (const core::FittedLine<Scalar>& axis : axes) {
        const Matrix3 across = Matrix3::Identity() - axis.direction * axis.direction.transpose();
        matrix += across;
        right += across * axis.point;
    }
    return matrix.ldlt().solve(right);
}

/// Is there no surface on the straight way from one place to another?
template <typename Scalar>
bool is_clear(const Body<Scalar>& body, const Vector3<Scalar>& from, const Vector3<Scalar>& to) {
    const Scalar length = (to - from).norm();
    if (!(length > 0)) return true;
    return body.tree.first_along(body.mesh, from, Vector3<Scalar>((to - from) / length)).distance > length;
}

/// The place where the axes of a junction's branches meet.
template <typename Scalar>
std::optional<Vector3<Scalar>> meeting_place(const BranchedCurve<Scalar>& curve, const Vector3<Scalar>& knot,
                                             const std::vector<BranchEnd>& ends,
                                             const std::vector<std::vector<BranchSection<Scalar>>>& sections,
                                             const Body<Scalar>& body, double straightness) {
    const Scalar ball = body.tree.distance(body.mesh, knot);
    std::vector<core::FittedLine<Scalar>> axes;
    for (const BranchEnd& end : ends) {
        const Branch<Scalar>& branch = curve.branches[end.branch];
        const auto axis = axis_of(branch, sections[end.branch], end.at_end,
                                  own_distance(curve, end.branch, end.at_end, ball), axis_length<Scalar> * ball);
        if (axis)
            axes.push_back(*axis);
        else if (length_of(branch) > longest_without_axis<Scalar> * ball)
            return std::nullopt;
    }
    if (axes.size() < 2) return std::nullopt;
    const Vector3<Scalar> place = nearest_place(axes, knot);
    const bool meet = std::all_of(axes.begin(), axes.end(), [&](const core::FittedLine<Scalar>& axis) {
        return axis.roughness < static_cast<Scalar>(straightness) * ball &&
               core::distance_to<Scalar>(axis, place) < meeting_miss<Scalar> * ball &&
               is_clear(body, place, axis.point);
    });
    if (!meet || !((place - knot).norm() < longest_move<Scalar> * ball)) return std::nullopt;
    return place;
}

} // namespace detail

/// How far from a knot the sections of a branch that leaves it are its own: where it has parted from the others, as two
/// tubes as thick as the ball at the knot do, at the ball's radius times the cotangent of half the angle between them,
/// and a bit. `branch` is one of the curve's, seen from its first knot or, `at_end`, from its last one. O(points of
/// the branches).
template <typename Scalar>
Scalar own_distance(const BranchedCurve<Scalar>& curve, std::size_t branch, bool at_end,
                    std::type_identity_t<Scalar> ball) {
    const Branch<Scalar>& own = curve.branches[branch];
    const int knot = at_end ? own.to : own.from;
    const Vector3<Scalar> direction = detail::direction_of(own, at_end, detail::leaving<Scalar> * ball);
    Scalar cotangent = 1; // of half the smallest angle
    for (std::size_t b = 0; b < curve.branches.size(); ++b) {
        const Branch<Scalar>& other = curve.branches[b];
        for (const bool other_end : {false, true}) {
            if ((other_end ? other.to : other.from) != knot || (b == branch && other_end == at_end)) continue;
            if (detail::length_of(other) < detail::shortest_beside<Scalar> * ball) continue;
            const Scalar cosine = direction.dot(detail::direction_of(other, other_end, detail::leaving<Scalar> * ball));
            cotangent = std::max(
                cotangent, std::sqrt(std::max(1 + cosine, Scalar(0)) / std::max(1 - cosine, core::rounding<Scalar>())));
        }
    }
    return std::min(detail::parted<Scalar> * cotangent, detail::latest_parting<Scalar>) * ball;
}

/// Per knot, the place where the axes of its branches meet, if it is a junction at which they do: each branch that is
/// long enough runs straight where its own sections begin, through their centres, and on from there these lines pass
/// by one place near the knot, to which they run inside the surface. So tubes meet, and shoulders do not. \param
/// sections per branch and point of its line. \param straightness the points through which an axis is laid may be off
/// it by this part of the ball's radius. O(branches points).
template <typename Scalar>
PlacesOfKnots<Scalar> meeting_axes(const BranchedCurve<Scalar>& curve,
                                   const std::vector<std::vector<BranchSection<Scalar>>>& sections,
                                   const Body<Scalar>& body, double straightness) {
    const std::vector<std::vector<detail::BranchEnd>> ends = detail::ends_at_knots(curve);
    PlacesOfKnots<Scalar> out(curve.knots.size());
    for (std::size_t k = 0; k < out.size(); ++k)
        if (ends[k].size() > 2)
            out[k] = detail::meeting_place(curve, curve.knots[k], ends[k], sections, body, straightness);
    return out;
}

} // namespace skelgen::curve
