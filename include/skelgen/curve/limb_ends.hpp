#pragma once

#include <skelgen/core/curve_graph.hpp>
#include <skelgen/core/curve_skeleton.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/mesh.hpp>

namespace skelgen {

namespace detail {

/// The mean place of the neighbours of `node` that are no leaves; its own when all are.
template <typename Scalar>
Vector3<Scalar> inward(const CurveSkeleton<Scalar>& curve, const CurveGraph<Scalar>& graph, int node) {
    Vector3<Scalar> sum = Vector3<Scalar>::Zero();
    int count = 0;
    for (const auto& [other, length] : graph.neighbours[static_cast<std::size_t>(node)]) {
        if (graph.degree(other) == 1) continue;
        sum += curve.nodes.row(other).transpose();
        ++count;
    }
    return count > 0 ? Vector3<Scalar>(sum / static_cast<Scalar>(count)) : curve.nodes.row(node).transpose();
}

} // namespace detail

/// What contraction leaves at the end of a limb may be a node on the surface, of radius 0, or even outside. Beside a
/// leaf such a node moves inward along the curve, half the way at a time, until it is inside, and takes its new radius
/// from its region, or from the nearest vertex where it has none left; a leaf without a radius takes over its
/// neighbour's. Regions index the vertices of `mesh`, outward and closed but for small holes. O(leaves * faces).
template <typename Scalar>
[[nodiscard]] CurveSkeleton<Scalar> settle_limb_ends(const CurveSkeleton<Scalar>& curve,
                                                     const TriangleMesh<Scalar>& mesh) {
    constexpr int most_steps = 6;
    const CurveGraph<Scalar> graph = curve_graph(curve);
    CurveSkeleton<Scalar> out = curve;
    for (int leaf = 0; leaf < graph.size(); ++leaf) {
        if (graph.degree(leaf) != 1) continue;
        const int node = graph.neighbours[static_cast<std::size_t>(leaf)][0].first;
        const auto k = static_cast<std::size_t>(node);
        const std::vector<int>& region = curve.regions[k];
        const Vector3<Scalar> start = curve.nodes.row(node).transpose(), target = detail::inward(curve, graph, node);
        Vector3<Scalar> place = start;
        if (!(curve.radii[k] > 0)) place = (place + target) / 2;
        for (int step = 0; step < most_steps && !(winding_number(mesh, place) > Scalar(0.5)); ++step)
            place = (place + target) / 2;
        if (place != start) {
            out.nodes.row(node) = place.transpose();
            out.radii[k] =
                region.empty() // its one vertex has become the tip
                    ? (mesh.vertices.rowwise() - place.transpose()).rowwise().norm().minCoeff()
                    : (mesh.vertices(region, Eigen::all).rowwise() - place.transpose()).rowwise().norm().mean();
        }
        Scalar& radius = out.radii[static_cast<std::size_t>(leaf)];
        if (!(radius > 0)) radius = out.radii[k];
    }
    return out;
}

} // namespace skelgen
