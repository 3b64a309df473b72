#pragma once

#include <skelgen/curve/branch_centring.hpp>

#include <algorithm>
#include <utility>

#include <skelgen/core/geometry.hpp>
#include <skelgen/core/header_only.hpp>
#include <skelgen/core/options.hpp>
#include <skelgen/core/polyline.hpp>
#include <skelgen/core/precision.hpp>
#include <skelgen/curve/attachment.hpp>
#include <skelgen/curve/axis_ends.hpp>
#include <skelgen/curve/parallel_branches.hpp>
#include <skelgen/curve/pruning.hpp>
#include <skelgen/curve/smoothing_spline.hpp>

namespace skelgen::curve {
namespace detail {

template <typename Scalar>
using SectionsOfBranches = std::vector<std::vector<BranchSection<Scalar>>>;

template <typename Scalar>
SectionsOfBranches<Scalar> all_sections(const BranchedCurve<Scalar>& branched, const Body<Scalar>& body,
                                        Scalar spacing) {
    SectionsOfBranches<Scalar> out;
    for (const Branch<Scalar>& branch : branched.branches)
        out.push_back(sections_across(body, branch.line, reach_in_spacings * spacing));
    return out;
}

/// Around a junction, sections are of all its branches and lie to the side of each. Their weight grows from nothing at
/// the first of these distances from the knot to the whole at the second one, in radii of the ball at the knot: the
/// sections of two tubes that meet at right angles are their own from 1 on. Calibrated on generated tubes and bodies.
template <typename Scalar>
inline constexpr Scalar shared_within = Scalar(0.7);
template <typename Scalar>
inline constexpr Scalar own_beyond = Scalar(1.2);

/// Do the branch's own sections begin close by the knot at one of its ends?
template <typename Scalar>
bool is_tight(const Branch<Scalar>& branch, const std::vector<BranchSection<Scalar>>& sections, bool at_end,
              const Body<Scalar>& body) {
    if (!at_end) return meets_tightly(branch.line, sections, body);
    return meets_tightly<Scalar>(branch.line.colwise().reverse(), {sections.rbegin(), sections.rend()}, body);
}

/// Points are drawn along the curve by this part of what draws them across: they slide, so that junctions come to their
/// places in few rounds; calibrated.
inline constexpr double slide = 0.2;

/// Per knot, whether it is a junction.
template <typename Scalar>
std::vector<bool> all_junctions(const BranchedCurve<Scalar>& branched) {
    std::vector<bool> out;
    for (const int degree : branched.degrees()) out.push_back(degree > 2);
    return out;
}

/// Per knot, whether it is a junction that all its branches meet tightly.
template <typename Scalar>
std::vector<bool> tight_junctions(const BranchedCurve<Scalar>& branched, const SectionsOfBranches<Scalar>& sections,
                                  const Body<Scalar>& body) {
    std::vector<bool> out = all_junctions(branched);
    for (std::size_t b = 0; b < sections.size(); ++b)
        for (const bool at_end : {false, true}) {
            const Branch<Scalar>& branch = branched.branches[b];
            const auto k = static_cast<std::size_t>(at_end ? branch.to : branch.from);
            if (out[k]) out[k] = is_tight(branch, sections[b], at_end, body);
        }
    return out;
}

/// Has a connected curve loops?
template <typename Scalar>
bool has_cycles(const BranchedCurve<Scalar>& branched) {
    const std::vector<int> degrees = branched.degrees();
    const auto knots = std::count_if(degrees.begin(), degrees.end(), [](int degree) { return degree > 0; });
    return static_cast<std::ptrdiff_t>(branched.branches.size()) >= knots;
}

/// Sections that count as little as they are the branch's own near these junctions.
template <typename Scalar>
SectionsOfBranches<Scalar> beyond_junctions(SectionsOfBranches<Scalar> sections, const BranchedCurve<Scalar>& branched,
                                            const Body<Scalar>& body, const std::vector<bool>& junctions) {
    for (std::size_t b = 0; b < sections.size(); ++b) {
        const Branch<Scalar>& branch = branched.branches[b];
        for (const int knot : {branch.from, branch.to}) {
            const auto k = static_cast<std::size_t>(knot);
            if (!junctions[k]) continue;
            const Scalar ball = body.tree.distance(body.mesh, branched.knots[k]);
            for (std::size_t i = 0; i < sections[b].size(); ++i) {
                const Vector3<Scalar> place = core::point(branch.line, static_cast<Eigen::Index>(i));
                const Scalar away = (place - branched.knots[k]).norm() / std::max(ball, core::rounding<Scalar>());
                sections[b][i].weight *=
                    std::clamp((away - shared_within<Scalar>) / (own_beyond<Scalar> - shared_within<Scalar>), Scalar(0),
                               Scalar(1));
            }
        }
    }
    return sections;
}

/// A curve has no more points than about this many: one of a body has 250 at the default spacing, 5000 at the finest.
inline constexpr int most_points = 5000;

template <typename Scalar>
Scalar total_length(const BranchedCurve<Scalar>& branched) {
    Scalar sum = 0;
    for (const Branch<Scalar>& branch : branched.branches)
        sum += core::arc_lengths(branch.line)[branch.line.rows() - 1];
    return sum;
}

/// Corners rounded off, as where branches have been joined anew.
template <typename Scalar>
BranchedCurve<Scalar> smoothed(BranchedCurve<Scalar> branched) {
    for (Branch<Scalar>& branch : branched.branches) {
        const Points<Scalar> line = branch.line;
        for (Eigen::Index i = 1; i + 1 < line.rows(); ++i)
            core::set_point(
                branch.line, i,
                Vector3<Scalar>((core::point(line, i - 1) + 2 * core::point(line, i) + core::point(line, i + 1)) / 4));
    }
    return branched;
}

/// A place inside a contour near one outside: the middle of the chord through the contour's nearest point.
template <typename Scalar>
Vector3<Scalar> place_within(const surface::Contour<Scalar>& contour, const Vector3<Scalar>& place) {
    const auto nearer = [&](const Vector3<Scalar>& a, const Vector3<Scalar>& b) {
        return (a - place).squaredNorm() < (b - place).squaredNorm();
    };
    const Vector3<Scalar> entry = *std::min_element(contour.points.begin(), contour.points.end(), nearer);
    // Of the chords from there, that one that comes nearest to going straight on.
    Vector3<Scalar> exit = entry;
    Scalar straightest = 0;
    for (const Vector3<Scalar>& p : contour.points) {
        const Vector3<Scalar> chord = p - entry;
        const Scalar cosine = chord.norm() > 0 ? chord.normalized().dot((entry - place).normalized()) : Scalar(0);
        if (!(cosine > straightest)) continue;
        straightest = cosine;
        exit = p;
    }
    return (entry + exit) / 2;
}

/// Moving a point in turns the sections of its neighbours: some rounds.
inline constexpr int pulls = 4;

/// Does a point lie outside its section?
template <typename Scalar>
bool is_outside(const BranchSection<Scalar>& section) {
    return section.thickness > 0 && !section.encloses;
}

template <typename Scalar>
bool any_outside(const SectionsOfBranches<Scalar>& sections) {
    for (const auto& of_branch : sections)
        if (std::any_of(of_branch.begin(), of_branch.end(), is_outside<Scalar>)) return true;
    return false;
}

/// Points that lie outside their sections moved into them.
template <typename Scalar>
BranchedCurve<Scalar> pulled_inside(BranchedCurve<Scalar> branched, const SectionsOfBranches<Scalar>& sections) {
    for (std::size_t b = 0; b < sections.size(); ++b)
        for (std::size_t i = 0; i < sections[b].size(); ++i) {
            const BranchSection<Scalar>& section = sections[b][i];
            if (!is_outside(section)) continue;
            const auto row = static_cast<Eigen::Index>(i);
            Points<Scalar>& line = branched.branches[b].line;
            core::set_point(line, row, place_within(section.contour, core::point(line, row)));
        }
    return branched;
}

} // namespace detail

SKELGEN_INLINE void validate(const BranchCentringOptions& options) {
    core::require_in_range("centring.spacing", options.spacing, 1e-4, 1.0);
    core::require_in_range("centring.rounds", options.rounds, 0, 100);
    core::require_in_range("centring.stiffness", options.stiffness, 0.0, 10.0);
    core::require_in_range("centring.least_relief", options.least_relief, 0.0, 100.0);
}

template <typename Scalar>
CentredBranches<Scalar> centre_branches(BranchedCurve<Scalar> branched, const Body<Scalar>& body,
                                        const BranchCentringOptions& options) {
    validate(options);
    const Scalar spacing = std::max(static_cast<Scalar>(options.spacing) * core::bounding_diagonal(body.mesh.vertices),
                                    detail::total_length(branched) / detail::most_points);
    const std::vector<Vector3<Scalar>> tips = branched.knots; // of those knots that are ends, and stay the same knots
    // Loops are mostly contacts: parts that touch have no axes that meet there.
    const bool has_loops = detail::has_cycles(branched);
    for (int round = 0; round < options.rounds; ++round) {
        const bool coarse = 3 * round < 2 * options.rounds;
        branched = resampled(std::move(branched), coarse ? 2 * spacing : spacing);
        const auto sections = detail::all_sections(branched, body, spacing);
        if (has_loops) {
            branched = smoothing_spline(std::move(branched), sections, tips, options.stiffness, 1);
        } else {
            // Axes meet first; then, where parts run into each other more widely than tubes, sections show the middle.
            const auto junctions =
                coarse ? detail::all_junctions(branched) : detail::tight_junctions(branched, sections, body);
            const auto own = detail::beyond_junctions(sections, branched, body, junctions);
            branched = smoothing_spline(std::move(branched), own, tips, options.stiffness, detail::slide);
        }
        branched = ends_on_axes(std::move(branched), sections, body);
        if (3 * round >= options.rounds) branched = merge_parallel_branches(std::move(branched), body);
    }
    branched = reattach_branches(resampled(std::move(branched), spacing), body, spacing);
    branched = prune_twigs(std::move(branched), body, options.least_relief);
    branched = detail::smoothed(resampled(std::move(branched), spacing));
    auto sections = detail::all_sections(branched, body, spacing);
    for (int round = 0; round < detail::pulls && detail::any_outside(sections); ++round) {
        branched = detail::pulled_inside(std::move(branched), sections);
        sections = detail::all_sections(branched, body, spacing);
    }
    return {std::move(branched), std::move(sections)};
}

} // namespace skelgen::curve
