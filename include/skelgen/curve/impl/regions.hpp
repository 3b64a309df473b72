#pragma once

#include <skelgen/curve/regions.hpp>

#include <skelgen/core/curve_graph.hpp>
#include <skelgen/core/error.hpp>

namespace skelgen::curve {

template <typename Scalar>
CurveSkeleton<Scalar> spread_regions(const CurveSkeleton<Scalar>& curve, const Proxy<Scalar>& proxy,
                                     const Body<Scalar>& body) {
    const std::vector<int> node = node_of_vertex(curve, proxy.mesh.vertices.rows());
    std::vector<core::Source<Scalar>> seeds;
    for (std::size_t v = 0; v < proxy.source.size(); ++v)
        if (proxy.source[v] >= 0) seeds.push_back({0, node[v], proxy.source[v]});
    const std::vector<int> owner = core::nearest_source(body.graph, seeds);
    CurveSkeleton<Scalar> out = curve;
    for (auto& region : out.regions) region.clear();
    for (std::size_t v = 0; v < owner.size(); ++v) {
        if (owner[v] < 0) throw Error(ErrorCode::internal, "a part of the surface is not connected to its proxy");
        out.regions[static_cast<std::size_t>(owner[v])].push_back(static_cast<int>(v));
    }
    return out;
}

} // namespace skelgen::curve
