#pragma once

#include <skelgen/embedding/reduced_graph.hpp>

#include <algorithm>
#include <utility>

#include <skelgen/core/curve_graph.hpp>

namespace skelgen::embedding {
namespace detail {

/// The branches as edges between the nodes that are not of degree 2; `place` as among those.
template <typename Scalar>
core::CurveGraph<Scalar> graph_of_branches(const core::CurveGraph<Scalar>& graph, const std::vector<int>& place,
                                           std::size_t count) {
    core::CurveGraph<Scalar> out;
    out.neighbours.resize(count);
    for (int v = 0; v < graph.size(); ++v) {
        if (place[at(v)] < 0) continue;
        for (auto [next, length] : graph.neighbours[at(v)]) {
            for (int before = v; graph.degree(next) == 2;) {
                const auto& [first, second] = std::pair(graph.neighbours[at(next)][0], graph.neighbours[at(next)][1]);
                const auto& onward = first.first == before ? second : first;
                before = next;
                next = onward.first;
                length += onward.second;
            }
            out.neighbours[at(place[at(v)])].emplace_back(place[at(next)], length);
        }
    }
    return out;
}

/// The nodes that are not of degree 2, with the distances between them; no radii yet.
template <typename Scalar>
ReducedGraph<Scalar> without_chains(const core::CurveGraph<Scalar>& graph) {
    ReducedGraph<Scalar> out;
    std::vector<int> place(graph.neighbours.size(), -1);
    for (int v = 0; v < graph.size(); ++v)
        if (graph.degree(v) != 2) {
            place[at(v)] = static_cast<int>(out.origin.size());
            out.origin.push_back(v);
            out.degree.push_back(graph.degree(v));
        }
    const auto n = static_cast<int>(out.origin.size());
    const core::CurveGraph<Scalar> branches = graph_of_branches(graph, place, out.origin.size());
    out.distances.resize(n, n);
    for (int i = 0; i < n; ++i) {
        const core::ShortestPaths<Scalar> paths = core::shortest_paths(branches, i);
        for (int k = 0; k < n; ++k) out.distances(i, k) = paths.distance[at(k)];
    }
    out.radius.assign(out.origin.size(), Scalar(0));
    return out;
}

/// Largest radius of the curve within `reach` of an end, along the curve.
template <typename Scalar>
Scalar end_thickness(const CurveSkeleton<Scalar>& curve, const core::CurveGraph<Scalar>& graph, int end, Scalar reach) {
    const std::vector<Scalar> distance = core::shortest_paths(graph, end, reach).distance;
    Scalar thickness = 0;
    for (std::size_t v = 0; v < curve.radii.size(); ++v)
        if (distance[v] <= reach) thickness = std::max(thickness, curve.radii[v]);
    return thickness;
}

/// Lengths relative to the largest distance.
template <typename Scalar>
ReducedGraph<Scalar> with_largest_distance_one(ReducedGraph<Scalar> graph) {
    const Scalar largest = graph.distances.size() > 0 ? graph.distances.maxCoeff() : Scalar(0);
    if (!(largest > 0)) return graph;
    graph.distances /= largest;
    for (Scalar& radius : graph.radius) radius /= largest;
    return graph;
}

/// The template's bones as a curve, each end joint followed by its tip.
template <typename Scalar>
CurveSkeleton<Scalar> bones(const SkeletonTemplate& skeleton_template) {
    const auto joints = static_cast<int>(skeleton_template.joints.size());
    CurveSkeleton<Scalar> out;
    out.nodes.resize(joints, 3);
    for (int j = 0; j < joints; ++j) {
        const TemplateJoint& joint = skeleton_template.joint(j);
        out.nodes.row(j) = joint.position.transpose().template cast<Scalar>();
        if (joint.parent >= 0) out.edges.push_back({joint.parent, j});
    }
    for (int j = 0; j < joints; ++j) {
        const TemplateJoint& joint = skeleton_template.joint(j);
        if (!joint.tip) continue;
        out.edges.push_back({j, static_cast<int>(out.nodes.rows())});
        out.nodes.conservativeResize(out.nodes.rows() + 1, 3);
        out.nodes.template bottomRows<1>() = joint.tip->transpose().template cast<Scalar>();
    }
    return out;
}

} // namespace detail

template <typename Scalar>
ReducedGraph<Scalar> reduce(const CurveSkeleton<Scalar>& curve) {
    // Of the curve's diameter, which is 2.4 m on an adult, from toe to fingertip: past the fingers and toes, which
    // leaves and extensions make thin, to the middle of the head, short of the chest.
    constexpr auto end_reach = static_cast<Scalar>(0.1);
    const core::CurveGraph<Scalar> graph = core::curve_graph(curve);
    ReducedGraph<Scalar> out = detail::without_chains(graph);
    const Scalar reach = end_reach * core::curve_diameter(graph);
    for (std::size_t i = 0; i < out.origin.size(); ++i)
        if (out.degree[i] == 1) out.radius[i] = detail::end_thickness(curve, graph, out.origin[i], reach);
    return detail::with_largest_distance_one(std::move(out));
}

template <typename Scalar>
ReducedGraph<Scalar> reduce(const SkeletonTemplate& skeleton_template) {
    ReducedGraph<Scalar> out = detail::without_chains(core::curve_graph(detail::bones<Scalar>(skeleton_template)));
    int tip = static_cast<int>(skeleton_template.joints.size()); // tips stand for the joints they belong to
    for (std::size_t j = 0; j < skeleton_template.joints.size(); ++j)
        if (skeleton_template.joints[j].tip)
            std::replace(out.origin.begin(), out.origin.end(), tip++, static_cast<int>(j));
    for (std::size_t i = 0; i < out.origin.size(); ++i)
        if (out.degree[i] == 1) out.radius[i] = static_cast<Scalar>(skeleton_template.joint(out.origin[i]).radius);
    return detail::with_largest_distance_one(std::move(out));
}

SKELGEN_INLINE double longest_path(const SkeletonTemplate& skeleton_template) {
    return core::curve_diameter(core::curve_graph(detail::bones<double>(skeleton_template)));
}

} // namespace skelgen::embedding
