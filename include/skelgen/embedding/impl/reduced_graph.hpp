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

/// The bones of a template as a curve.
template <typename Scalar>
struct BonesCurve {
    CurveSkeleton<Scalar> curve;
    std::vector<int> joint_of_node; ///< of a tip the joint that it belongs to
};

/// The template's bones as a curve, each end joint followed by its tip; without what the body lacks.
template <typename Scalar>
BonesCurve<Scalar> bones(const SkeletonTemplate& skeleton_template) {
    BonesCurve<Scalar> out;
    std::vector<int> node_of_joint(skeleton_template.joints.size(), -1);
    const auto append = [&](const Vector3<double>& place, int joint, int before) {
        const auto node = static_cast<int>(out.joint_of_node.size());
        out.curve.nodes.conservativeResize(node + 1, 3);
        out.curve.nodes.row(node) = place.transpose().template cast<Scalar>();
        out.joint_of_node.push_back(joint);
        if (before >= 0) out.curve.edges.push_back({before, node});
        return node;
    };
    for (int j = 0; j < static_cast<int>(skeleton_template.joints.size()); ++j) {
        const TemplateJoint& joint = skeleton_template.joint(j);
        if (joint.is_absent || is_bare(skeleton_template, j)) continue;
        node_of_joint[at(j)] = append(joint.position, j, joint.parent < 0 ? -1 : node_of_joint[at(joint.parent)]);
    }
    for (int j = 0; j < static_cast<int>(skeleton_template.joints.size()); ++j) {
        const TemplateJoint& joint = skeleton_template.joint(j);
        if (joint.tip && !joint.is_absent) append(*joint.tip, j, node_of_joint[at(j)]);
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
    const detail::BonesCurve<Scalar> bones = detail::bones<Scalar>(skeleton_template);
    ReducedGraph<Scalar> out = detail::without_chains(core::curve_graph(bones.curve));
    for (int& origin : out.origin) origin = bones.joint_of_node[detail::at(origin)];
    for (std::size_t i = 0; i < out.origin.size(); ++i)
        if (out.degree[i] == 1) out.radius[i] = static_cast<Scalar>(skeleton_template.joint(out.origin[i]).radius);
    return detail::with_largest_distance_one(std::move(out));
}

SKELGEN_INLINE double longest_path(const SkeletonTemplate& skeleton_template) {
    return core::curve_diameter(core::curve_graph(detail::bones<double>(skeleton_template).curve));
}

} // namespace skelgen::embedding
