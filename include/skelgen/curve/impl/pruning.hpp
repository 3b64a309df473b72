#pragma once

#include <skelgen/curve/pruning.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include <skelgen/core/curve_graph.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/header_only.hpp>
#include <skelgen/core/options.hpp>
#include <skelgen/core/polyline.hpp>

namespace skelgen::curve {
namespace detail {

/// Without the nodes of `branch` but its last, which inherits their regions.
template <typename Scalar>
CurveSkeleton<Scalar> without_branch(CurveSkeleton<Scalar> curve, const std::vector<int>& branch) {
    std::vector<int> index(curve.regions.size(), 0);
    auto& heir = curve.regions[static_cast<std::size_t>(branch.back())];
    for (std::size_t i = 0; i + 1 < branch.size(); ++i) {
        index[static_cast<std::size_t>(branch[i])] = -1;
        const auto& region = curve.regions[static_cast<std::size_t>(branch[i])];
        heir.insert(heir.end(), region.begin(), region.end());
    }
    std::sort(heir.begin(), heir.end());

    int kept = 0;
    for (std::size_t v = 0; v < index.size(); ++v) {
        if (index[v] < 0) continue;
        index[v] = kept;
        const auto k = static_cast<std::size_t>(kept);
        if (k != v) {
            curve.nodes.row(kept) = curve.nodes.row(static_cast<Eigen::Index>(v)).eval();
            curve.regions[k] = std::move(curve.regions[v]);
            if (!curve.radii.empty()) curve.radii[k] = curve.radii[v];
        }
        ++kept;
    }
    curve.nodes.conservativeResize(kept, 3);
    curve.regions.resize(static_cast<std::size_t>(kept));
    if (!curve.radii.empty()) curve.radii.resize(static_cast<std::size_t>(kept));

    std::vector<std::array<int, 2>> edges;
    for (const auto& [a, b] : curve.edges)
        if (index[static_cast<std::size_t>(a)] >= 0 && index[static_cast<std::size_t>(b)] >= 0)
            edges.push_back({index[static_cast<std::size_t>(a)], index[static_cast<std::size_t>(b)]});
    curve.edges = std::move(edges);
    return curve;
}

/// Cuts the shortest leaf branch again and again until none is shorter than `length`. Shortest first, because a branch
/// that loses its neighbour grows into the rest of the curve: of five fingers one goes on as the hand.
template <typename Scalar>
CurveSkeleton<Scalar> cut_short_branches(CurveSkeleton<Scalar> curve, Scalar length) {
    while (true) {
        const core::CurveGraph<Scalar> graph = core::curve_graph(curve);
        std::vector<int> shortest;
        Scalar shortest_length = length;
        for (int v = 0; v < graph.size(); ++v) {
            if (graph.degree(v) != 1) continue;
            std::vector<int> branch = core::branch(graph, v, graph.neighbours[static_cast<std::size_t>(v)][0].first);
            const Scalar branch_length = core::path_length(curve, branch);
            if (graph.degree(branch.back()) < 3 || !(branch_length < shortest_length)) continue;
            shortest = std::move(branch);
            shortest_length = branch_length;
        }
        if (shortest.empty()) return curve;
        curve = without_branch(std::move(curve), shortest);
    }
}

/// A branch of which less than this part of its junction's radius is outside of the balls around all others is hidden
/// in them. A working value: hardly more than its tip, which is at the surface.
template <typename Scalar>
inline constexpr Scalar hidden = Scalar(0.1);

/// A ball inside of the surface.
template <typename Scalar>
struct Ball {
    Vector3<Scalar> centre;
    Scalar radius;
};

/// The balls around a line's points, as large as the surface lets them be. O(k) distances to the surface.
template <typename Scalar>
std::vector<Ball<Scalar>> balls_along(const Points<Scalar>& line, const Body<Scalar>& body) {
    std::vector<Ball<Scalar>> balls;
    for (Eigen::Index i = 0; i < line.rows(); ++i) {
        const Vector3<Scalar> centre = core::point(line, i);
        balls.push_back({centre, body.tree.distance(body.mesh, centre)});
    }
    return balls;
}

/// Arc length of a branch outside of the balls around all others. O(k^2) for k points.
template <typename Scalar>
Scalar length_outside(const Points<Scalar>& line, std::size_t branch,
                      const std::vector<std::vector<Ball<Scalar>>>& balls_of_branch) {
    const auto clearance = [&](const Vector3<Scalar>& p) {
        Scalar least = std::numeric_limits<Scalar>::infinity();
        for (std::size_t b = 0; b < balls_of_branch.size(); ++b)
            if (b != branch)
                for (const auto& [centre, radius] : balls_of_branch[b])
                    least = std::min(least, (p - centre).norm() - radius);
        return least;
    };
    Scalar length = 0, before = clearance(core::point(line, 0));
    for (Eigen::Index i = 1; i < line.rows(); ++i) {
        const Scalar here = clearance(core::point(line, i));
        const Scalar inside = std::max(-before, Scalar(0)) + std::max(-here, Scalar(0));
        const Scalar outside = std::max(before, Scalar(0)) + std::max(here, Scalar(0));
        if (outside > 0) length += outside / (outside + inside) * (line.row(i) - line.row(i - 1)).norm();
        before = here;
    }
    return length;
}

} // namespace detail

SKELGEN_INLINE void validate(const PruningOptions& options) {
    core::require_in_range("pruning.spur", options.spur, 0.0, 1.0);
    core::require_in_range("pruning.branch", options.branch, 0.0, 1.0);
}

template <typename Scalar>
CurveSkeleton<Scalar> prune(const CurveSkeleton<Scalar>& curve, const PruningOptions& options) {
    validate(options);
    const Scalar unit = core::curve_diameter(core::curve_graph(curve));
    CurveSkeleton<Scalar> out = detail::cut_short_branches(curve, static_cast<Scalar>(options.spur) * unit);
    return detail::cut_short_branches(std::move(out), static_cast<Scalar>(options.branch) * unit);
}

template <typename Scalar>
BranchedCurve<Scalar> prune_twigs(BranchedCurve<Scalar> branched, const Body<Scalar>& body, double least_relief) {
    while (true) {
        const std::vector<int> degrees = branched.degrees();
        std::vector<std::vector<detail::Ball<Scalar>>> balls;
        for (const Branch<Scalar>& branch : branched.branches) balls.push_back(detail::balls_along(branch.line, body));
        std::size_t twig = branched.branches.size();
        auto least = static_cast<Scalar>(least_relief);
        for (std::size_t b = 0; b < branched.branches.size(); ++b) {
            const Branch<Scalar>& branch = branched.branches[b];
            const int from = degrees[static_cast<std::size_t>(branch.from)],
                      to = degrees[static_cast<std::size_t>(branch.to)];
            if ((from == 1) == (to == 1) || std::max(from, to) < 3) continue;
            const Scalar radius = (from == 1 ? balls[b].back() : balls[b].front()).radius;
            const Scalar length = core::arc_lengths(branch.line)[branch.line.rows() - 1];
            const bool is_hidden =
                length > 2 * radius && detail::length_outside(branch.line, b, balls) < detail::hidden<Scalar> * radius;
            const Scalar relief = is_hidden ? Scalar(0) : (length - radius) / radius;
            if (!(relief < least)) continue;
            least = relief;
            twig = b;
        }
        if (twig == branched.branches.size()) return branched;
        const Branch<Scalar> cut = branched.branches[twig];
        branched.branches.erase(branched.branches.begin() + static_cast<std::ptrdiff_t>(twig));
        const int left = degrees[static_cast<std::size_t>(cut.from)] == 1 ? cut.to : cut.from;
        for (Branch<Scalar>& branch : branched.branches)
            if (branch.from == left || branch.to == left) branch.origins = united_origins(branch.origins, cut.origins);
        branched = without_knot(std::move(branched), left);
    }
}

} // namespace skelgen::curve
