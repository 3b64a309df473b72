#pragma once

#include <skelgen/curve/limb_ends.hpp>

#include <skelgen/core/curve_graph.hpp>
#include <skelgen/core/geometry.hpp>

namespace skelgen::curve {
namespace detail {

/// The mean place of the neighbours of `node` that are no leaves; its own when all are.
template <typename Scalar>
Vector3<Scalar> inward_place(const CurveSkeleton<Scalar>& curve, const core::CurveGraph<Scalar>& graph, int node) {
    Vector3<Scalar> sum = Vector3<Scalar>::Zero();
    int count = 0;
    for (const auto& [other, length] : graph.neighbours[static_cast<std::size_t>(node)]) {
        if (graph.degree(other) == 1) continue;
        sum += core::point(curve.nodes, other);
        ++count;
    }
    return count > 0 ? Vector3<Scalar>(sum / static_cast<Scalar>(count)) : core::point(curve.nodes, node);
}

/// Mean distance from a place to the vertices of a region; to the nearest of all where the region is empty.
template <typename Scalar>
Scalar radius_at(const Vector3<Scalar>& place, const std::vector<int>& region, const TriangleMesh<Scalar>& mesh) {
    const auto distance = [&](int v) { return (core::point(mesh.vertices, v) - place).norm(); };
    if (region.empty()) return distance(core::nearest_vertex(mesh, place));
    Scalar sum = 0;
    for (const int v : region) sum += distance(v);
    return sum / static_cast<Scalar>(region.size());
}

} // namespace detail

template <typename Scalar>
CurveSkeleton<Scalar> place_limb_ends(const CurveSkeleton<Scalar>& curve, const TriangleMesh<Scalar>& mesh) {
    constexpr int most_steps = 6; // then the node is within a sixty-fourth of the way of the next one
    constexpr auto inside = Scalar(0.5);
    const core::CurveGraph<Scalar> graph = core::curve_graph(curve);
    CurveSkeleton<Scalar> out = curve;
    for (int leaf = 0; leaf < graph.size(); ++leaf) {
        if (graph.degree(leaf) != 1) continue;
        const int node = graph.neighbours[static_cast<std::size_t>(leaf)][0].first;
        const auto k = static_cast<std::size_t>(node);
        const Vector3<Scalar> start = core::point(curve.nodes, node);
        const Vector3<Scalar> target = detail::inward_place(curve, graph, node);
        Vector3<Scalar> place = start;
        if (!(curve.radii[k] > 0)) place = (place + target) / 2;
        for (int step = 0; step < most_steps && !(core::winding_number(mesh, place) > inside); ++step)
            place = (place + target) / 2;
        if (place != start) {
            out.nodes.row(node) = place.transpose();
            out.radii[k] = detail::radius_at(place, curve.regions[k], mesh);
        }
        Scalar& radius = out.radii[static_cast<std::size_t>(leaf)];
        if (!(radius > 0)) radius = out.radii[k];
    }
    return out;
}

} // namespace skelgen::curve
