#pragma once

#include <skelgen/curve/branch_centring.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/SparseCholesky>

#include <skelgen/core/geometry.hpp>
#include <skelgen/core/header_only.hpp>
#include <skelgen/core/options.hpp>
#include <skelgen/core/polyline.hpp>
#include <skelgen/core/precision.hpp>
#include <skelgen/curve/attachment.hpp>
#include <skelgen/curve/axis_ends.hpp>
#include <skelgen/curve/parallel_branches.hpp>
#include <skelgen/curve/pruning.hpp>

#include <cstdlib>

namespace skelgen::curve {
namespace detail {

template <typename Scalar>
using SectionsOfBranches = std::vector<std::vector<BranchSection<Scalar>>>;

/// Spacings from the line to a contour that does not go around it but is its branch's all the same.
inline constexpr int section_reach = 4;

template <typename Scalar>
SectionsOfBranches<Scalar> all_sections(const BranchedCurve<Scalar>& branched, const Body<Scalar>& body,
                                        Scalar spacing) {
    SectionsOfBranches<Scalar> out;
    for (const Branch<Scalar>& branch : branched.branches)
        out.push_back(sections_across(body, branch.line, section_reach * spacing));
    return out;
}

/// Where the unknowns of a branch's points are: knots come first, then the inner points of one branch after the other.
template <typename Scalar>
std::vector<std::vector<int>> unknowns_of(const BranchedCurve<Scalar>& branched) {
    int next = static_cast<int>(branched.knots.size());
    std::vector<std::vector<int>> out;
    for (const Branch<Scalar>& branch : branched.branches) {
        std::vector<int> at{branch.from};
        for (Eigen::Index i = 1; i + 1 < branch.line.rows(); ++i) at.push_back(next++);
        at.push_back(branch.to);
        out.push_back(std::move(at));
    }
    return out;
}

/// The energy of the spline, a quadratic form in the points' coordinates: its matrix and its right side.
class SplineSystem {
public:
    using Number = core::Accumulator;

    explicit SplineSystem(int unknowns) : right_(Points<Number>::Zero(unknowns, 3)) {}

    void attract(int point, const Vector3<Number>& target, Number weight) {
        entries_.emplace_back(point, point, weight);
        for (int k = 0; k < 3; ++k) right_(point, k) += weight * target[k];
    }

    /// Second difference of three points in a row.
    void straighten(const std::array<int, 3>& points, Number weight) {
        constexpr Number factors[3] = {1, -2, 1};
        for (std::size_t a = 0; a < 3; ++a)
            for (std::size_t b = 0; b < 3; ++b)
                entries_.emplace_back(points[a], points[b], weight * factors[a] * factors[b]);
    }

    [[nodiscard]] Points<Number> solve() const {
        Eigen::SparseMatrix<Number> matrix(right_.rows(), right_.rows());
        matrix.setFromTriplets(entries_.begin(), entries_.end());
        return Eigen::SimplicialLDLT<Eigen::SparseMatrix<Number>>(matrix).solve(right_);
    }

private:
    std::vector<Eigen::Triplet<Number>> entries_;
    Points<Number> right_;
};

/// Sections of more weight are their branch's own.
template <typename Scalar>
inline constexpr Scalar sure_section = Scalar(0.5);

/// The thickness by which each point of a branch is stiff: its section's, or that of the next one before that is sure.
template <typename Scalar>
std::vector<Scalar> thickness_along(const std::vector<BranchSection<Scalar>>& sections) {
    std::vector<Scalar> out(sections.size(), Scalar(0));
    Scalar last = 0;
    for (const BranchSection<Scalar>& section : sections)
        if (last == 0 && section.weight > 0) last = section.thickness;
    for (std::size_t i = 0; i < sections.size(); ++i) {
        if (sections[i].weight > sure_section<Scalar>) last = sections[i].thickness;
        out[i] = last;
    }
    return out;
}

/// The smoothing spline through the sections' centres: the sum of their squared distances and of the squared curvature
/// times a length to the fourth, the stiffness times the thickness, is least.
template <typename Scalar>
BranchedCurve<Scalar> fitted(BranchedCurve<Scalar> branched, const SectionsOfBranches<Scalar>& sections,
                             const std::vector<Vector3<Scalar>>& tips, double stiffness) {
    using core::Accumulator;
    constexpr Accumulator inertia = 1e-3;    // holds to its place what nothing else does
    constexpr Accumulator tip_weight = 0.03; // a short limb must not be drawn into the trunk by the sections there
    const std::vector<std::vector<int>> unknowns = unknowns_of(branched);
    int count = static_cast<int>(branched.knots.size());
    for (const std::vector<int>& at : unknowns) count += static_cast<int>(at.size()) - 2;
    SplineSystem system(count);
    for (std::size_t k = 0; k < branched.knots.size(); ++k)
        system.attract(static_cast<int>(k), branched.knots[k].template cast<Accumulator>(), inertia);
    const std::vector<int> degrees = branched.degrees();
    for (std::size_t k = 0; k < tips.size(); ++k)
        if (degrees[k] == 1) system.attract(static_cast<int>(k), tips[k].template cast<Accumulator>(), tip_weight);
    for (std::size_t b = 0; b < unknowns.size(); ++b) {
        const Points<Scalar>& line = branched.branches[b].line;
        const std::vector<int>& at = unknowns[b];
        const Scalar spacing = core::arc_lengths(line)[line.rows() - 1] / static_cast<Scalar>(line.rows() - 1);
        const std::vector<Scalar> thickness = thickness_along(sections[b]);
        // A ring no longer than its knot's ball is around is a handle in a contact of two parts: sections show those.
        const bool is_handle =
            at.front() == at.back() && core::arc_lengths(line)[line.rows() - 1] < 6 * thickness.front();
        for (std::size_t i = 1; i + 1 < at.size(); ++i) {
            const BranchSection<Scalar>& section = sections[b][i];
            const Vector3<Accumulator> place =
                core::point(line, static_cast<Eigen::Index>(i)).template cast<Accumulator>();
            system.attract(at[i], place, is_handle ? 1 : inertia);
            if (is_handle) continue;
            if (section.weight > 0) system.attract(at[i], section.centre.template cast<Accumulator>(), section.weight);
            if (!(spacing > 0)) continue;
            const Accumulator ratio = stiffness * static_cast<Accumulator>(thickness[i] / spacing);
            system.straighten({at[i - 1], at[i], at[i + 1]}, ratio * ratio * ratio * ratio);
        }
        // The point at which a ring begins has no section: it goes on straight between its neighbours.
        const bool is_ring = at.front() == at.back() && degrees[static_cast<std::size_t>(at.front())] == 2;
        if (is_ring && !is_handle && spacing > 0) {
            const Accumulator ratio = stiffness * static_cast<Accumulator>(thickness.front() / spacing);
            system.straighten({at[at.size() - 2], at.front(), at[1]}, ratio * ratio * ratio * ratio);
        }
    }
    const Points<Scalar> moved = system.solve().template cast<Scalar>();
    for (std::size_t k = 0; k < branched.knots.size(); ++k)
        branched.knots[k] = core::point(moved, static_cast<Eigen::Index>(k));
    for (std::size_t b = 0; b < unknowns.size(); ++b)
        for (std::size_t i = 0; i < unknowns[b].size(); ++i)
            core::set_point(branched.branches[b].line, static_cast<Eigen::Index>(i),
                            core::point(moved, unknowns[b][i]));
    return branched;
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

/// Corners rounded off over some points, as where branches have been joined anew.
template <typename Scalar>
BranchedCurve<Scalar> smoothed(BranchedCurve<Scalar> branched) {
    constexpr int passes = 1;
    for (Branch<Scalar>& branch : branched.branches)
        for (int pass = 0; pass < passes; ++pass) {
            const Points<Scalar> line = branch.line;
            for (Eigen::Index i = 1; i + 1 < line.rows(); ++i)
                core::set_point(
                    branch.line, i,
                    Vector3<Scalar>((core::point(line, i - 1) + 2 * core::point(line, i) + core::point(line, i + 1)) /
                                    4));
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

/// Moves points that lie outside their sections into them; whether there were any.
template <typename Scalar>
bool pull_inside(BranchedCurve<Scalar>& branched, const SectionsOfBranches<Scalar>& sections) {
    bool moved = false;
    for (std::size_t b = 0; b < sections.size(); ++b)
        for (std::size_t i = 0; i < sections[b].size(); ++i) {
            const BranchSection<Scalar>& section = sections[b][i];
            if (section.encloses || !(section.thickness > 0)) continue;
            const auto row = static_cast<Eigen::Index>(i);
            Points<Scalar>& line = branched.branches[b].line;
            core::set_point(line, row, place_within(section.contour, core::point(line, row)));
            moved = true;
        }
    return moved;
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
    for (int round = 0; round < options.rounds; ++round) {
        const bool coarse = 3 * round < 2 * options.rounds;
        branched = resampled(std::move(branched), coarse ? 2 * spacing : spacing);
        const auto sections = detail::all_sections(branched, body, spacing);
        branched = detail::fitted(std::move(branched), sections, tips, options.stiffness);
        branched = ends_on_axes(std::move(branched), sections, body);
        if (3 * round >= options.rounds) branched = merge_parallel_branches(std::move(branched), body);
    }
    branched = reattach_branches(resampled(std::move(branched), spacing), body, spacing);
    branched = prune_twigs(std::move(branched), body, options.least_relief);
    branched = detail::smoothed(resampled(std::move(branched), spacing));
    auto sections = detail::all_sections(branched, body, spacing);
    for (int round = 0; round < detail::pulls && detail::pull_inside(branched, sections); ++round)
        sections = detail::all_sections(branched, body, spacing);
    return {std::move(branched), std::move(sections)};
}

} // namespace skelgen::curve
