#pragma once

#include <skelgen/curve/leaf_extension.hpp>

#include <algorithm>
#include <utility>
#include <vector>

#include <skelgen/core/curve_graph.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/header_only.hpp>
#include <skelgen/core/options.hpp>
#include <skelgen/curve/impl/regions.hpp>

namespace skelgen::curve {
namespace detail {

/// The largest part of a node's region that hangs together on the surface. \param node_of_vertex as of the curve; -1
/// then for the region's vertices.
template <typename Scalar>
std::vector<int> largest_connected_part(const core::SurfaceGraph<Scalar>& surface, const std::vector<int>& region,
                                        int node, std::vector<int>& node_of_vertex) {
    std::vector<int> largest;
    const auto is_new = [&](int v) {
        int& owner = node_of_vertex[static_cast<std::size_t>(v)];
        if (owner != node) return false;
        owner = -1;
        return true;
    };
    for (const int start : region) {
        if (!is_new(start)) continue;
        std::vector<int> part{start};
        for (std::size_t i = 0; i < part.size(); ++i)
            for (const auto& [w, length] : surface.neighbours[static_cast<std::size_t>(part[i])])
                if (is_new(w)) part.push_back(w);
        if (part.size() > largest.size()) largest = std::move(part);
    }
    return largest;
}

/// The first node on the way back from `leaf` that is at least `reach` away along the curve, or else the one where its
/// branch ends.
template <typename Scalar>
int anchor_node(const CurveSkeleton<Scalar>& curve, const core::CurveGraph<Scalar>& graph, int leaf, Scalar reach) {
    const int neighbour = graph.neighbours[static_cast<std::size_t>(leaf)].front().first;
    int anchor = leaf;
    Scalar walked = 0;
    for (const int node : core::branch(graph, leaf, neighbour)) {
        if (walked >= reach) break;
        walked += (core::point(curve.nodes, node) - core::point(curve.nodes, anchor)).norm();
        anchor = node;
    }
    return anchor;
}

} // namespace detail

SKELGEN_INLINE void validate(const LeafExtensionOptions& options) {
    core::require_in_range("leaves.anchor", options.anchor, 0.0, 1.0);
}

template <typename Scalar>
CurveSkeleton<Scalar> extend_leaves(const CurveSkeleton<Scalar>& curve, const Body<Scalar>& body,
                                    const LeafExtensionOptions& options) {
    validate(options);
    const core::CurveGraph<Scalar> graph = core::curve_graph(curve);
    const Scalar reach = static_cast<Scalar>(options.anchor) * core::curve_diameter(graph);
    std::vector<int> node_of_vertex = curve::node_of_vertex(curve, body.mesh.vertices.rows());
    CurveSkeleton<Scalar> out = curve;
    for (int leaf = 0; leaf < graph.size(); ++leaf) {
        if (graph.degree(leaf) != 1) continue;
        const int anchor = detail::anchor_node(curve, graph, leaf, reach);
        auto& region = out.regions[static_cast<std::size_t>(leaf)];
        int tip = -1;
        Scalar farthest = (core::point(curve.nodes, leaf) - core::point(curve.nodes, anchor)).norm();
        for (const int v : detail::largest_connected_part(body.graph, region, leaf, node_of_vertex)) {
            const Scalar distance = (core::point(body.mesh.vertices, v) - core::point(curve.nodes, anchor)).norm();
            if (distance > farthest) {
                farthest = distance;
                tip = v;
            }
        }
        if (tip < 0) continue;
        const auto added = static_cast<int>(out.nodes.rows());
        out.nodes.conservativeResize(added + 1, 3);
        out.nodes.row(added) = body.mesh.vertices.row(tip);
        out.edges.push_back({leaf, added});
        std::erase(region, tip);
        out.regions.push_back({tip});
        if (!out.radii.empty()) out.radii.push_back(Scalar(0));
    }
    return out;
}

} // namespace skelgen::curve
