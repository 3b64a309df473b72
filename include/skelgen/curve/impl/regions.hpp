#pragma once

#include <skelgen/curve/regions.hpp>

#include <skelgen/core/curve_graph.hpp>
#include <skelgen/core/error.hpp>

namespace skelgen::curve {

template <typename Scalar>
CurveSkeleton<Scalar> spread_regions(const CurveSkeleton<Scalar>& curve, const Proxy<Scalar>& proxy,
                                     const Body<Scalar>& body) {
    const std::vector<int> node = node_of_vertex(curve, proxy.mesh.vertices.rows());
    std::vector<int> seeds, seed_node;
    for (std::size_t v = 0; v < proxy.source.size(); ++v) {
        if (proxy.source[v] < 0) continue;
        seeds.push_back(proxy.source[v]);
        seed_node.push_back(node[v]);
    }
    const std::vector<int> claim = core::nearest_source(body.graph, seeds);
    CurveSkeleton<Scalar> out = curve;
    for (auto& region : out.regions) region.clear();
    for (std::size_t v = 0; v < claim.size(); ++v) {
        if (claim[v] < 0) throw Error(ErrorCode::internal, "a part of the surface is not connected to its proxy");
        const int owner = seed_node[static_cast<std::size_t>(claim[v])];
        out.regions[static_cast<std::size_t>(owner)].push_back(static_cast<int>(v));
    }
    return out;
}

} // namespace skelgen::curve
