#pragma once

#include <skelgen/core/curve_graph.hpp>
#include <skelgen/core/curve_skeleton.hpp>
#include <skelgen/core/mesh.hpp>

namespace skelgen {

/// How a limb's end is found.
struct LeafExtensionOptions {
    double anchor =
        0.05; ///< how far back on the curve to stand when looking for the end, relative to the largest distance
};

namespace detail {

/// The largest subset of `vertices` (ascending) that hangs together on the surface.
template <typename Scalar>
std::vector<int> largest_connected_part(const CurveGraph<Scalar>& surface, const std::vector<int>& vertices) {
    std::vector<int> largest;
    std::vector<bool> seen(vertices.size(), false);
    const auto place = [&](int v) { return std::lower_bound(vertices.begin(), vertices.end(), v) - vertices.begin(); };
    for (std::size_t start = 0; start < vertices.size(); ++start) {
        if (seen[start]) continue;
        seen[start] = true;
        std::vector<int> part{vertices[start]};
        for (std::size_t i = 0; i < part.size(); ++i)
            for (const auto& [w, length] : surface.neighbours[static_cast<std::size_t>(part[i])]) {
                const auto k = static_cast<std::size_t>(place(w));
                if (k >= vertices.size() || vertices[k] != w || seen[k]) continue;
                seen[k] = true;
                part.push_back(w);
            }
        if (part.size() > largest.size()) largest = std::move(part);
    }
    return largest;
}

} // namespace detail

/// Contraction shortens limbs; this gives every leaf a last node at the end of its limb: the vertex of the leaf's
/// region that lies farthest from a point a little way back on the curve. Regions index the vertices of `mesh`; of a
/// region in several pieces only the largest counts, since where two limbs touch a few vertices may have gone to the
/// wrong one. `surface` as from surface_graph(mesh). O(k^2 log k + n).
template <typename Scalar>
[[nodiscard]] CurveSkeleton<Scalar> extend_leaves(const CurveSkeleton<Scalar>& curve, const TriangleMesh<Scalar>& mesh,
                                                  const CurveGraph<Scalar>& surface,
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
        for (const int v : detail::largest_connected_part(surface, region)) {
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
