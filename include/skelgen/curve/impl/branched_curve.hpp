#pragma once

#include <skelgen/curve/branched_curve.hpp>

#include <algorithm>

#include <skelgen/core/curve_graph.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/polyline.hpp>

namespace skelgen::curve {
namespace detail {

template <typename Scalar>
Points<Scalar> points_of(const Points<Scalar>& nodes, const std::vector<int>& path) {
    Points<Scalar> line(static_cast<Eigen::Index>(path.size()), 3);
    for (std::size_t i = 0; i < path.size(); ++i)
        core::set_point(line, static_cast<Eigen::Index>(i), core::point(nodes, path[i]));
    return line;
}

} // namespace detail

template <typename Scalar>
SplitCurve<Scalar> split_branches(const CurveSkeleton<Scalar>& curve) {
    const core::CurveGraph<Scalar> graph = core::curve_graph(curve);
    const std::vector<std::vector<int>> paths = core::branches(graph);
    SplitCurve<Scalar> out;
    std::vector<int>& origin = out.origin_of_node;
    origin.assign(static_cast<std::size_t>(graph.size()), -1);
    const auto make_knot = [&](int node) {
        int& knot = origin[static_cast<std::size_t>(node)];
        if (knot >= 0) return;
        knot = static_cast<int>(out.branched.knots.size());
        out.branched.knots.push_back(core::point(curve.nodes, node));
    };
    for (int v = 0; v < graph.size(); ++v)
        if (graph.degree(v) != 2) make_knot(v);
    for (const std::vector<int>& path : paths) make_knot(path.front()); // rings
    int next = static_cast<int>(out.branched.knots.size());
    for (const std::vector<int>& path : paths) {
        const int from = origin[static_cast<std::size_t>(path.front())],
                  to = origin[static_cast<std::size_t>(path.back())];
        for (std::size_t i = 1; i + 1 < path.size(); ++i) origin[static_cast<std::size_t>(path[i])] = next;
        out.branched.branches.push_back(
            {from, to, detail::points_of(curve.nodes, path), united_origins({from, to}, {next})});
        ++next;
    }
    return out;
}

template <typename Scalar>
BranchedCurve<Scalar> resampled(BranchedCurve<Scalar> curve, std::type_identity_t<Scalar> spacing) {
    for (Branch<Scalar>& branch : curve.branches) {
        const Eigen::Index least_edges = branch.from == branch.to ? 3 : 2;
        const auto length = core::arc_lengths(branch.line)[branch.line.rows() - 1];
        branch.line = core::resample(branch.line, std::min(spacing, length / static_cast<Scalar>(least_edges)));
    }
    return curve;
}

template <typename Scalar>
Branch<Scalar> turned(Branch<Scalar> branch) {
    std::swap(branch.from, branch.to);
    branch.line = branch.line.colwise().reverse().eval();
    return branch;
}

template <typename Scalar>
BranchedCurve<Scalar> without_knot(BranchedCurve<Scalar> curve, int knot) {
    std::vector<std::size_t> there;
    for (std::size_t b = 0; b < curve.branches.size(); ++b)
        if (curve.branches[b].from == knot || curve.branches[b].to == knot) there.push_back(b);
    if (there.size() != 2) return curve; // also a ring
    Branch<Scalar> first = curve.branches[there[0]], second = curve.branches[there[1]];
    if (first.to != knot) first = turned(std::move(first));
    if (second.from != knot) second = turned(std::move(second));
    if (first.from == first.to || second.from == second.to) return curve;
    Branch<Scalar> whole{first.from, second.to, Points<Scalar>(first.line.rows() + second.line.rows() - 1, 3),
                         united_origins(first.origins, second.origins)};
    whole.line << first.line, second.line.bottomRows(second.line.rows() - 1);
    curve.branches[there[0]] = std::move(whole);
    curve.branches.erase(curve.branches.begin() + static_cast<std::ptrdiff_t>(there[1]));
    return curve;
}

template <typename Scalar>
JoinedCurve<Scalar> join_branches(const BranchedCurve<Scalar>& branched) {
    const std::vector<int> degrees = branched.degrees();
    JoinedCurve<Scalar> out;
    std::vector<int> node_of_knot(degrees.size(), -1);
    std::vector<Vector3<Scalar>> nodes;
    const bool alone = branched.branches.empty(); // a single node is all that there is
    for (std::size_t k = 0; k < degrees.size(); ++k) {
        if (degrees[k] == 0 && !alone) continue;
        node_of_knot[k] = static_cast<int>(nodes.size());
        nodes.push_back(branched.knots[k]);
    }
    for (const Branch<Scalar>& branch : branched.branches) {
        std::vector<int> path{node_of_knot[static_cast<std::size_t>(branch.from)]};
        for (Eigen::Index i = 1; i + 1 < branch.line.rows(); ++i) {
            path.push_back(static_cast<int>(nodes.size()));
            nodes.push_back(core::point(branch.line, i));
        }
        path.push_back(node_of_knot[static_cast<std::size_t>(branch.to)]);
        for (std::size_t i = 1; i < path.size(); ++i)
            out.curve.edges.push_back({std::min(path[i - 1], path[i]), std::max(path[i - 1], path[i])});
        out.nodes_of_branch.push_back(std::move(path));
    }
    std::sort(out.curve.edges.begin(), out.curve.edges.end());
    out.curve.nodes.resize(static_cast<Eigen::Index>(nodes.size()), 3);
    for (std::size_t i = 0; i < nodes.size(); ++i)
        core::set_point(out.curve.nodes, static_cast<Eigen::Index>(i), nodes[i]);
    out.curve.regions.resize(nodes.size());
    return out;
}

} // namespace skelgen::curve
