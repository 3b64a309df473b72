#pragma once

#include <skelgen/curve/branch_centring.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>

#include <skelgen/core/geometry.hpp>
#include <skelgen/core/header_only.hpp>
#include <skelgen/core/options.hpp>
#include <skelgen/core/parallel.hpp>
#include <skelgen/core/polyline.hpp>
#include <skelgen/core/precision.hpp>
#include <skelgen/curve/impl/attachment.hpp>
#include <skelgen/curve/impl/axis_ends.hpp>
#include <skelgen/curve/impl/meeting_axes.hpp>
#include <skelgen/curve/impl/parallel_branches.hpp>
#include <skelgen/curve/impl/smoothing_spline.hpp>
#include <skelgen/curve/pruning.hpp>

namespace skelgen::curve {
namespace detail {

template <typename Scalar>
using SectionsOfBranches = std::vector<std::vector<BranchSection<Scalar>>>;

template <typename Scalar>
SectionsOfBranches<Scalar> all_sections(const BranchedCurve<Scalar>& branched, const Body<Scalar>& body,
                                        Scalar spacing) {
    constexpr std::size_t in_a_row = 8;
    SectionsOfBranches<Scalar> out;
    std::vector<std::pair<std::size_t, Eigen::Index>> points;
    for (std::size_t b = 0; b < branched.branches.size(); ++b) {
        const Eigen::Index count = branched.branches[b].line.rows();
        out.emplace_back(static_cast<std::size_t>(count));
        for (Eigen::Index i = 1; i + 1 < count; ++i) points.emplace_back(b, i);
    }
    core::parallel_for(points.size(), in_a_row, [&](std::size_t p) {
        const auto [b, i] = points[p];
        out[b][static_cast<std::size_t>(i)] =
            section_across(body, branched.branches[b].line, i, reach_in_spacings * spacing);
    });
    return out;
}

/// Sections count nothing from a junction where axes meet on to this part of the way to where they are the branch's
/// own.
template <typename Scalar>
inline constexpr Scalar shared_part = Scalar(0.6);

/// By how much the sections' centres may be off an axis that is taken to be straight, in radii of the junction's ball,
/// in the rounds in which points come to their places and in the last ones; calibrated on generated tubes.
inline constexpr double straight_at_first = 0.04, straight_at_last = 0.01;

/// Sections that count as little as they are the branch's own near the junctions where axes meet; without contours.
template <typename Scalar>
SectionsOfBranches<Scalar> beyond_junctions(const SectionsOfBranches<Scalar>& given,
                                            const BranchedCurve<Scalar>& branched, const Body<Scalar>& body,
                                            const PlacesOfKnots<Scalar>& junctions) {
    SectionsOfBranches<Scalar> sections;
    for (const auto& of_branch : given) {
        sections.emplace_back();
        for (const BranchSection<Scalar>& section : of_branch)
            sections.back().push_back(
                {section.centre, section.normal, section.thickness, section.weight, section.encloses, {}});
    }
    for (std::size_t b = 0; b < sections.size(); ++b)
        for (const bool at_end : {false, true}) {
            const Branch<Scalar>& branch = branched.branches[b];
            const auto k = static_cast<std::size_t>(at_end ? branch.to : branch.from);
            if (!junctions[k]) continue;
            const Scalar own = own_distance(branched, b, at_end, body.tree.distance(body.mesh, branched.knots[k]));
            for (std::size_t i = 0; i < sections[b].size(); ++i) {
                const Vector3<Scalar> place = core::point(branch.line, static_cast<Eigen::Index>(i));
                const Scalar away = (place - branched.knots[k]).norm() / std::max(own, core::rounding<Scalar>());
                sections[b][i].weight *=
                    std::clamp((away - shared_part<Scalar>) / (1 - shared_part<Scalar>), Scalar(0), Scalar(1));
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

/// A place inside a section's contour near one outside: on a chord from where the contour comes nearest, `depth` along
/// it or in its middle; of the chords on which that lies inside, the one that goes straightest on. The place itself
/// where there is none.
template <typename Scalar>
Vector3<Scalar> place_within(const BranchSection<Scalar>& section, const Vector3<Scalar>& place, Scalar depth) {
    const auto& points = section.contour.points;
    Vector3<Scalar> entry = place;
    Scalar nearest = std::numeric_limits<Scalar>::infinity();
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Vector3<Scalar>&from = points[i], &to = points[(i + 1) % points.size()];
        const auto [distance, along] = core::nearest_on_segment<Scalar, 3>(place, from, to);
        if (!(distance < nearest)) continue;
        nearest = distance;
        entry = from + along * (to - from);
    }
    const Vector3<Scalar> on = (entry - place).normalized();
    Vector3<Scalar> best = place;
    Scalar straightest = 0;
    for (const Vector3<Scalar>& exit : points) {
        const Scalar length = (exit - entry).norm();
        if (!((exit - entry).dot(on) > straightest * length)) continue;
        const Vector3<Scalar> inner = entry + std::min(depth / length, Scalar(0.5)) * (exit - entry);
        if (!surface::relate(section.contour, inner, section.normal).encloses) continue;
        straightest = (exit - entry).dot(on) / length;
        best = inner;
    }
    return best;
}

/// Moving a point in turns the sections of its neighbours: some rounds.
inline constexpr int pulls = 4;

template <typename Scalar>
bool any_outside(const SectionsOfBranches<Scalar>& sections) {
    for (const auto& of_branch : sections)
        if (std::any_of(of_branch.begin(), of_branch.end(), is_outside<Scalar>)) return true;
    return false;
}

/// Points that lie outside their sections moved into them, no deeper than a spacing, so that they stay beside each
/// other.
template <typename Scalar>
BranchedCurve<Scalar> pulled_inside(BranchedCurve<Scalar> branched, const SectionsOfBranches<Scalar>& sections,
                                    Scalar spacing) {
    for (std::size_t b = 0; b < sections.size(); ++b)
        for (std::size_t i = 0; i < sections[b].size(); ++i) {
            const BranchSection<Scalar>& section = sections[b][i];
            if (!is_outside(section)) continue;
            const auto row = static_cast<Eigen::Index>(i);
            Points<Scalar>& line = branched.branches[b].line;
            core::set_point(line, row, place_within(section, core::point(line, row), spacing));
        }
    return branched;
}

/// Rounds before those after which branches that run along each other become one: a third of them.
inline int rounds_apart(const BranchCentringOptions& options) { return (options.rounds + 2) / 3; }

/// Between points of the curve: as the options say, wider where there would be too many.
template <typename Scalar>
Scalar spacing_of(const BranchedCurve<Scalar>& branched, const Body<Scalar>& body,
                  const BranchCentringOptions& options) {
    return std::max(static_cast<Scalar>(options.spacing) * core::bounding_diagonal(body.mesh.vertices),
                    total_length(branched) / most_points);
}

/// One round of moving branches to the middle of the surface. \param tips the places of those knots that are ends, and
/// stay the same knots.
template <typename Scalar>
BranchedCurve<Scalar> centring_round(BranchedCurve<Scalar> branched, const Body<Scalar>& body,
                                     const std::vector<Vector3<Scalar>>& tips, const BranchCentringOptions& options,
                                     Scalar spacing, bool coarse) {
    branched = resampled(std::move(branched), coarse ? 2 * spacing : spacing);
    const auto sections = all_sections(branched, body, spacing);
    const auto junctions = meeting_axes(branched, sections, body, coarse ? straight_at_first : straight_at_last);
    auto beyond = beyond_junctions(sections, branched, body, junctions); // arguments are evaluated in any order
    branched = smoothing_spline(std::move(branched), std::move(beyond), tips, junctions, options.stiffness);
    return ends_on_axes(std::move(branched), sections, body);
}

/// The rest of the way, from where branches have come close to the middle on.
template <typename Scalar>
CentredBranches<Scalar> centred(BranchedCurve<Scalar> branched, const Body<Scalar>& body,
                                const std::vector<Vector3<Scalar>>& tips, const BranchCentringOptions& options,
                                Scalar spacing) {
    for (int round = rounds_apart(options); round < options.rounds; ++round) {
        const bool coarse = 3 * round < 2 * options.rounds;
        branched = centring_round(std::move(branched), body, tips, options, spacing, coarse);
        branched = merge_parallel_branches(std::move(branched), body);
    }
    branched = resampled(std::move(branched), spacing);
    const auto junctions = meeting_axes(branched, all_sections(branched, body, spacing), body, straight_at_last);
    branched = reattach_branches(std::move(branched), junctions, body, spacing);
    branched = prune_twigs(std::move(branched), body, options.least_relief);
    branched = smoothed(resampled(std::move(branched), spacing));
    auto sections = all_sections(branched, body, spacing);
    return {std::move(branched), std::move(sections)};
}

/// The sections of a line some of whose points have been moved: anew where those are that a section follows.
template <typename Scalar>
std::vector<BranchSection<Scalar>> sections_anew(std::vector<BranchSection<Scalar>> sections,
                                                 const Points<Scalar>& before, const Points<Scalar>& line,
                                                 const Body<Scalar>& body, Scalar spacing) {
    for (Eigen::Index i = 1; i + 1 < line.rows(); ++i) {
        const Eigen::Index first = std::max<Eigen::Index>(0, i - section_tangent_reach);
        const Eigen::Index count = std::min(line.rows(), i + section_tangent_reach + 1) - first;
        if (line.middleRows(first, count) != before.middleRows(first, count))
            sections[static_cast<std::size_t>(i)] = section_across(body, line, i, reach_in_spacings * spacing);
    }
    return sections;
}

/// All that lies outside pulled inside, as far as that goes.
template <typename Scalar>
CentredBranches<Scalar> all_pulled_inside(CentredBranches<Scalar> curve, const Body<Scalar>& body, Scalar spacing) {
    for (int round = 0; round < pulls && any_outside(curve.sections); ++round) {
        const BranchedCurve<Scalar> before = curve.branched;
        curve.branched = pulled_inside(std::move(curve.branched), curve.sections, spacing);
        for (std::size_t b = 0; b < curve.sections.size(); ++b)
            curve.sections[b] = sections_anew(std::move(curve.sections[b]), before.branches[b].line,
                                              curve.branched.branches[b].line, body, spacing);
    }
    return curve;
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
    const Scalar spacing = detail::spacing_of(branched, body, options);
    const std::vector<Vector3<Scalar>> tips = branched.knots;
    for (int round = 0; round < detail::rounds_apart(options); ++round)
        branched = detail::centring_round(std::move(branched), body, tips, options, spacing, true);
    return detail::all_pulled_inside(detail::centred(std::move(branched), body, tips, options, spacing), body, spacing);
}

template <typename Scalar>
BranchedCurve<Scalar> centre_roughly(BranchedCurve<Scalar> branched, const Body<Scalar>& body,
                                     const BranchCentringOptions& options) {
    validate(options);
    constexpr int few = 3; // with fewer, some bodies lose a limb
    const Scalar spacing = detail::spacing_of(branched, body, options), wide = 2 * spacing;
    const std::vector<Vector3<Scalar>> tips = branched.knots;
    const int rounds = std::min(few, options.rounds);
    for (int round = 0; round < rounds; ++round) { // the last one finely: ends lie where the axes last lead
        const bool is_last = round + 1 == rounds;
        branched = detail::centring_round(std::move(branched), body, tips, options, is_last ? spacing : wide, false);
        if (round > 0 && !is_last) branched = merge_parallel_branches(std::move(branched), body);
    }
    branched = prune_twigs(resampled(std::move(branched), wide), body, options.least_relief);
    return detail::smoothed(resampled(std::move(branched), wide));
}

} // namespace skelgen::curve
