#pragma once

#include <skelgen/curve/regions.hpp>

#include <skelgen/core/curve_graph.hpp>
#include <skelgen/core/error.hpp>

namespace skelgen::curve {

template <typename Scalar>
std::vector<int> nearest_of_proxy(const Proxy<Scalar>& proxy, const Body<Scalar>& body) {
    std::vector<core::Source<Scalar>> seeds;
    for (std::size_t v = 0; v < proxy.source.size(); ++v)
        if (proxy.source[v] >= 0) seeds.push_back({0, static_cast<int>(v), proxy.source[v]});
    return core::nearest_source(body.graph, seeds);
}

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
