#pragma once

#include <array>
#include <vector>

#include <Eigen/SparseCholesky>

#include <skelgen/core/geometry.hpp>
#include <skelgen/core/polyline.hpp>
#include <skelgen/core/precision.hpp>
#include <skelgen/curve/branch_sections.hpp>
#include <skelgen/curve/branched_curve.hpp>

namespace skelgen::curve {

namespace detail {

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

/// The energy of the spline, a quadratic form in each of the points' coordinates: its matrix and its right sides.
class SplineSystem {
public:
    using Number = core::Accumulator;

    explicit SplineSystem(int points) : right_(Points<Number>::Zero(points, 3)) {}

    void attract(int point, const Vector3<Number>& target, Number weight) {
        entries_.emplace_back(point, point, weight);
        right_.row(point) += weight * target.transpose();
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
        const Eigen::SimplicialLDLT<Eigen::SparseMatrix<Number>> factors(matrix);
        Points<Number> out(right_.rows(), 3);
        for (int axis = 0; axis < 3; ++axis) out.col(axis) = factors.solve(right_.col(axis));
        return out;
    }

private:
    std::vector<Eigen::Triplet<Number>> entries_;
    Points<Number> right_;
};

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

} // namespace detail

/// The smoothing spline through the sections' centres: the sum of their squared distances, each times its section's
/// weight, and of the squared curvature times a length to the fourth, `stiffness` times the thickness, is least.
/// Branches bend, and meet at their knots at any angle: where no section counts, a branch goes on straight. \param
/// branched with lines of evenly spaced points. \param sections per branch and point of its line. \param tips per knot,
/// a place that holds it weakly where it is an end. O(k).
template <typename Scalar>
BranchedCurve<Scalar>
smoothing_spline(BranchedCurve<Scalar> branched, const std::vector<std::vector<BranchSection<Scalar>>>& sections,
                 const std::vector<Vector3<Scalar>>& tips, const PlacesOfKnots<Scalar>& junctions, double stiffness) {
    using core::Accumulator;
    constexpr Accumulator inertia = 1e-3;    // holds to its place what nothing else does
    constexpr Accumulator tip_weight = 0.03; // a short limb must not be drawn into the trunk by the sections there
    const std::vector<std::vector<int>> unknowns = detail::unknowns_of(branched);
    int count = static_cast<int>(branched.knots.size());
    for (const std::vector<int>& at : unknowns) count += static_cast<int>(at.size()) - 2;
    detail::SplineSystem system(count);
    for (std::size_t k = 0; k < branched.knots.size(); ++k)
        system.attract(static_cast<int>(k), branched.knots[k].template cast<Accumulator>(), inertia);
    const std::vector<int> degrees = branched.degrees();
    for (std::size_t k = 0; k < tips.size(); ++k)
        if (degrees[k] == 1) system.attract(static_cast<int>(k), tips[k].template cast<Accumulator>(), tip_weight);
    for (std::size_t k = 0; k < junctions.size(); ++k)
        if (junctions[k]) system.attract(static_cast<int>(k), junctions[k]->template cast<Accumulator>(), 1);
    for (std::size_t b = 0; b < unknowns.size(); ++b) {
        const Points<Scalar>& line = branched.branches[b].line;
        const std::vector<int>& at = unknowns[b];
        const Scalar spacing = core::arc_lengths(line)[line.rows() - 1] / static_cast<Scalar>(line.rows() - 1);
        const std::vector<Scalar> thickness = detail::thickness_along(sections[b]);
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

} // namespace skelgen::curve
