#pragma once

#include <vector>

#include <skelgen/core/curve_graph.hpp>
#include <skelgen/core/curve_skeleton.hpp>
#include <skelgen/core/error.hpp>
#include <skelgen/curve/proxy.hpp>
#include <skelgen/surface/body.hpp>

namespace skelgen::curve {

/// The inverse of the regions: per vertex of a mesh of so many the node that it belongs to, -1 for those that are in no
/// region. O(vertices).
template <typename Scalar>
[[nodiscard]] std::vector<int> node_of_vertex(const CurveSkeleton<Scalar>& curve, Eigen::Index vertices) {
    std::vector<int> node(static_cast<std::size_t>(vertices), -1);
    for (std::size_t k = 0; k < curve.regions.size(); ++k)
        for (const int v : curve.regions[k]) node[static_cast<std::size_t>(v)] = static_cast<int>(k);
    return node;
}

/// Per vertex of the body that of its proxy which is nearest along the surface, not through space, so that a hand on a
/// thigh stays a hand. O(n log n).
template <typename Scalar>
std::vector<int> nearest_of_proxy(const Proxy<Scalar>& proxy, const Body<Scalar>& body) {
    std::vector<core::Source<Scalar>> seeds;
    for (std::size_t v = 0; v < proxy.source.size(); ++v)
        if (proxy.source[v] >= 0) seeds.push_back({0, static_cast<int>(v), proxy.source[v]});
    return core::nearest_source(body.graph, seeds);
}

/// The same curve with regions of the body's vertices in place of those of its proxy: each of them goes to the node of
/// the proxy's vertex that is nearest to it. A region may come out empty. O(n).
template <typename Scalar>
CurveSkeleton<Scalar> spread_regions(CurveSkeleton<Scalar> curve, const std::vector<int>& nearest,
                                     const Proxy<Scalar>& proxy) {
    const std::vector<int> node = node_of_vertex(curve, proxy.mesh.vertices.rows());
    for (auto& region : curve.regions) region.clear();
    for (std::size_t v = 0; v < nearest.size(); ++v) {
        const int owner = nearest[v] < 0 ? -1 : node[static_cast<std::size_t>(nearest[v])];
        if (owner < 0) throw Error(ErrorCode::internal, "a part of the surface is not connected to its proxy");
        curve.regions[static_cast<std::size_t>(owner)].push_back(static_cast<int>(v));
    }
    return curve;
}

} // namespace skelgen::curve
