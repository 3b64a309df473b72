#pragma once

#include <skelgen/core/curve_graph.hpp>
#include <skelgen/core/curve_skeleton.hpp>
#include <skelgen/core/mesh.hpp>

namespace skelgen {

/// How a limb's end is found.
struct LeafExtensionOptions {
    double anchor = 0.05; ///< how far back on the curve to stand when looking for the end, relative to the largest distance
};

/// Contraction shortens limbs; this gives every leaf a last node at the end of its limb: the vertex of the leaf's region
/// that lies farthest from a point a little way back on the curve. Regions index the vertices of `mesh`. O(k^2 log k + n).
template <typename Scalar>
[[nodiscard]] CurveSkeleton<Scalar> extend_leaves(const CurveSkeleton<Scalar>& curve, const TriangleMesh<Scalar>& mesh,
                                                  const LeafExtensionOptions& options = {}) {
    const CurveGraph<Scalar> graph = curve_graph(curve);
    const Scalar reach = static_cast<Scalar>(options.anchor) * curve_diameter(graph);
    CurveSkeleton<Scalar> out = curve;
    for (int leaf = 0; leaf < graph.size(); ++leaf) {
        if (graph.degree(leaf) != 1) continue;
        int anchor = leaf, previous = -1;
        Scalar walked = 0;
        while (walked < reach && (anchor == leaf || graph.degree(anchor) == 2)) {
            const auto& list = graph.neighbours[static_cast<std::size_t>(anchor)];
            const auto& next = list.size() > 1 && list[0].first == previous ? list[1] : list[0];
            previous = anchor;
            anchor = next.first;
            walked += next.second;
        }
        auto& region = out.regions[static_cast<std::size_t>(leaf)];
        int tip = -1;
        Scalar farthest = (curve.nodes.row(leaf) - curve.nodes.row(anchor)).norm();
        for (const int v : region) {
            const Scalar distance = (mesh.vertices.row(v) - curve.nodes.row(anchor)).norm();
            if (distance > farthest) {
                farthest = distance;
                tip = v;
            }
        }
        if (tip < 0) continue;
        const auto added = static_cast<int>(out.nodes.rows());
        out.nodes.conservativeResize(added + 1, 3);
        out.nodes.row(added) = mesh.vertices.row(tip);
        out.edges.push_back({leaf, added});
        std::erase(region, tip);
        out.regions.push_back({tip});
        if (!out.radii.empty()) out.radii.push_back(Scalar(0));
    }
    return out;
}

} // namespace skelgen
