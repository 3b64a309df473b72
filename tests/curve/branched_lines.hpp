#pragma once

#include <algorithm>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

#include <skelgen/core/geometry.hpp>
#include <skelgen/core/polyline.hpp>
#include <skelgen/curve/branch_sections.hpp>
#include <skelgen/curve/branched_curve.hpp>

#include "shapes.hpp"

namespace skelgen::test {

/// The line through these points, evenly spaced by about `spacing`.
inline Points<double> line_through(const std::vector<Vec3>& points, double spacing) {
    return core::resample(make_mesh(points, {}).vertices, spacing);
}

/// Branches between these knots, each straight; origins as from split_branches.
inline curve::BranchedCurve<double>
straight_branches(const std::vector<Vec3>& knots, const std::vector<std::pair<int, int>>& branches, double spacing) {
    curve::BranchedCurve<double> out{knots, {}};
    for (const auto& [from, to] : branches) {
        const Vec3 a = knots[static_cast<std::size_t>(from)], b = knots[static_cast<std::size_t>(to)];
        const int number = static_cast<int>(knots.size() + out.branches.size());
        out.branches.push_back(
            {from, to, line_through({a, b}, spacing), {std::min(from, to), std::max(from, to), number}});
    }
    return out;
}

/// The sections of a line across itself, as many as it has points; none at its first and its last one.
template <typename Scalar>
std::vector<curve::BranchSection<Scalar>> sections_across(const Body<Scalar>& body, const Points<Scalar>& line,
                                                          std::type_identity_t<Scalar> reach) {
    std::vector<curve::BranchSection<Scalar>> out(static_cast<std::size_t>(line.rows()));
    for (Eigen::Index i = 1; i + 1 < line.rows(); ++i)
        out[static_cast<std::size_t>(i)] = curve::section_across(body, line, i, reach);
    return out;
}

/// The sections across each branch at all of its points.
inline std::vector<std::vector<curve::BranchSection<double>>> sections_of(const curve::BranchedCurve<double>& branched,
                                                                          const Body<double>& body, double reach) {
    std::vector<std::vector<curve::BranchSection<double>>> out;
    for (const curve::Branch<double>& branch : branched.branches)
        out.push_back(sections_across(body, branch.line, reach));
    return out;
}

/// The knots with that many branches.
inline std::vector<Vec3> knots_of_degree(const curve::BranchedCurve<double>& branched, int degree) {
    std::vector<Vec3> out;
    const std::vector<int> degrees = branched.degrees();
    for (std::size_t k = 0; k < degrees.size(); ++k)
        if (degrees[k] == degree) out.push_back(branched.knots[k]);
    return out;
}

/// Distance from a place to the nearest of some others.
inline double distance_to_nearest(const Vec3& place, const std::vector<Vec3>& others) {
    double least = std::numeric_limits<double>::infinity();
    for (const Vec3& other : others) least = std::min(least, (other - place).norm());
    return least;
}

inline double total_length(const curve::BranchedCurve<double>& branched) {
    double sum = 0;
    for (const curve::Branch<double>& branch : branched.branches)
        sum += core::arc_lengths(branch.line)[branch.line.rows() - 1];
    return sum;
}

} // namespace skelgen::test
