#pragma once

#include <skelgen/curve/inside_way.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include <skelgen/core/curve_graph.hpp>
#include <skelgen/core/geometry.hpp>

namespace skelgen::curve {
namespace detail {

/// Inscribed balls as a graph, in which those are neighbours whose vertices are, and which overlap: a node per ball,
/// lengths between centres.
template <typename Scalar>
core::CurveGraph<Scalar> ball_graph(const MedialBalls<Scalar>& balls) {
    core::CurveGraph<Scalar> out;
    out.neighbours.resize(static_cast<std::size_t>(balls.radii.size()));
    for (Eigen::Index f = 0; f < balls.faces.rows(); ++f)
        for (int k = 0; k < 3; ++k) { // each edge twice: from its faces on both sides
            const int u = balls.faces(f, k), v = balls.faces(f, (k + 1) % 3);
            const Scalar length = (core::point(balls.centres, u) - core::point(balls.centres, v)).norm();
            if (length < balls.radii[u] + balls.radii[v])
                out.neighbours[static_cast<std::size_t>(u)].emplace_back(v, length);
        }
    return out;
}

/// The deepest ball that holds a place, -1 where none does.
template <typename Scalar>
int ball_around(const MedialBalls<Scalar>& balls, const Vector3<Scalar>& place) {
    int best = -1;
    Scalar deepest = 0;
    for (Eigen::Index v = 0; v < balls.radii.size(); ++v) {
        const Scalar depth = balls.radii[v] - (core::point(balls.centres, v) - place).norm();
        if (!(depth > deepest)) continue;
        deepest = depth;
        best = static_cast<int>(v);
    }
    return best;
}

/// The way from one place inside to another, both included, k x 3.
template <typename Scalar>
std::optional<Points<Scalar>> way_inside(const MedialBalls<Scalar>& balls, const core::CurveGraph<Scalar>& graph,
                                         const Vector3<Scalar>& from, const Vector3<Scalar>& to) {
    const int first = ball_around(balls, from), last = ball_around(balls, to);
    if (first < 0 || last < 0) return std::nullopt;
    const auto paths = core::shortest_paths(graph, first);
    if (!std::isfinite(paths.distance[static_cast<std::size_t>(last)])) return std::nullopt;
    const std::vector<int> nodes = paths.path_to(last);
    Points<Scalar> way(static_cast<Eigen::Index>(nodes.size()) + 2, 3);
    way.row(0) = from.transpose();
    for (std::size_t i = 0; i < nodes.size(); ++i)
        way.row(static_cast<Eigen::Index>(i) + 1) = balls.centres.row(nodes[i]);
    way.row(way.rows() - 1) = to.transpose();
    return way;
}

/// A piece of a line from one of its points to another one.
struct LinePiece {
    Eigen::Index first, last;
};

/// The next piece from point `begin` on whose points lie outside but for its ends; none beside the line's own ends.
template <typename Scalar>
std::optional<LinePiece> outside_piece(const std::vector<BranchSection<Scalar>>& sections, Eigen::Index begin) {
    const auto size = static_cast<Eigen::Index>(sections.size());
    const auto is_out = [&](Eigen::Index i) { // there are no sections at the ends, nor far from any surface outside
        return i > 0 && i + 1 < size && !sections[static_cast<std::size_t>(i)].encloses;
    };
    Eigen::Index first = begin;
    while (first + 1 < size && (is_out(first) || !is_out(first + 1))) ++first;
    Eigen::Index last = first + 1;
    while (last < size && is_out(last)) ++last;
    if (last >= size) return std::nullopt;
    return LinePiece{first, last};
}

} // namespace detail

template <typename Scalar>
BranchedCurve<Scalar> led_inside(BranchedCurve<Scalar> branched,
                                 const std::vector<std::vector<BranchSection<Scalar>>>& sections,
                                 const MedialBalls<Scalar>& balls) {
    std::optional<core::CurveGraph<Scalar>> graph;
    for (std::size_t b = 0; b < sections.size(); ++b) {
        const Points<Scalar> line = branched.branches[b].line;
        Points<Scalar> led(0, 3);
        Eigen::Index kept = 0; // of the line
        const auto append = [&](const Points<Scalar>& points) {
            const Eigen::Index rows = led.rows();
            led.conservativeResize(rows + points.rows(), 3);
            led.bottomRows(points.rows()) = points;
        };
        for (auto piece = detail::outside_piece(sections[b], 0); piece;
             piece = detail::outside_piece(sections[b], piece->last)) {
            if (!graph) graph = detail::ball_graph(balls);
            const auto way = detail::way_inside<Scalar>(balls, *graph, core::point(line, piece->first),
                                                        core::point(line, piece->last));
            if (!way) continue;
            append(line.middleRows(kept, piece->first - kept));
            append(way->topRows(way->rows() - 1));
            kept = piece->last;
        }
        if (kept == 0) continue;
        append(line.bottomRows(line.rows() - kept));
        branched.branches[b].line = std::move(led);
    }
    return branched;
}

} // namespace skelgen::curve
