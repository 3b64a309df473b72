#pragma once

#include <array>
#include <cmath>
#include <map>
#include <vector>

#include <skelgen/core/curve_skeleton.hpp>
#include <skelgen/core/mesh.hpp>

namespace skelgen {

namespace detail {

/// Which node each mesh vertex collapsed to.
template <typename Scalar>
std::vector<int> node_of_vertex(const CurveSkeleton<Scalar>& curve, Eigen::Index vertices) {
    std::vector<int> node(static_cast<std::size_t>(vertices), -1);
    for (std::size_t k = 0; k < curve.regions.size(); ++k)
        for (const int v : curve.regions[k]) node[static_cast<std::size_t>(v)] = static_cast<int>(k);
    return node;
}

/// Length-weighted mean displacement over one boundary loop of a region.
struct LoopDisplacement {
    Vector3<double> weighted = Vector3<double>::Zero();
    double length = 0;
};

} // namespace detail

/// Embedding refinement (Au08 section 5): contraction drifts off centre; each node moves back by how far, on average
/// over the boundary loops of its region, the surface has been displaced. `mesh` is the mesh that was contracted,
/// `contracted` its contracted vertices. Leaves have one loop, junctions three or more. O(faces).
template <typename Scalar>
[[nodiscard]] CurveSkeleton<Scalar> centre_nodes(const CurveSkeleton<Scalar>& curve, const TriangleMesh<Scalar>& mesh,
                                                 const Points<Scalar>& contracted) {
    const std::vector<int> node = detail::node_of_vertex(curve, mesh.vertices.rows());
    std::map<std::array<int, 2>, detail::LoopDisplacement> loops; // (node, neighbour) -> loop on the node's side
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int u = mesh.faces(f, k), v = mesh.faces(f, (k + 1) % 3), w = mesh.faces(f, (k + 2) % 3);
            const int here = node[static_cast<std::size_t>(u)], there = node[static_cast<std::size_t>(w)];
            // An edge u-v within the region whose opposite corner lies in another one is part of that loop.
            if (node[static_cast<std::size_t>(v)] != here || there == here) continue;
            detail::LoopDisplacement& loop = loops[{here, there}];
            const double length = (mesh.vertices.row(u) - mesh.vertices.row(v)).norm();
            const Vector3<double> displacement =
                0.5 * (contracted.row(u) - mesh.vertices.row(u) + contracted.row(v) - mesh.vertices.row(v)).transpose();
            loop.weighted += length * displacement;
            loop.length += length;
        }

    // A region without an inner edge on its boundary (one vertex thick) takes the mean over its vertices instead.
    std::vector<Vector3<double>> sum(curve.regions.size(), Vector3<double>::Zero());
    std::vector<double> count(curve.regions.size(), 0);
    for (const auto& [key, loop] : loops) {
        sum[static_cast<std::size_t>(key[0])] += loop.weighted / loop.length;
        count[static_cast<std::size_t>(key[0])] += 1;
    }
    CurveSkeleton<Scalar> out = curve;
    out.radii.assign(curve.regions.size(), Scalar(0));
    for (std::size_t k = 0; k < curve.regions.size(); ++k) {
        const auto row = static_cast<Eigen::Index>(k);
        if (count[k] == 0) {
            for (const int v : curve.regions[k])
                sum[k] += (contracted.row(v) - mesh.vertices.row(v)).transpose().template cast<double>();
            count[k] = static_cast<double>(curve.regions[k].size());
        }
        out.nodes.row(row) -= (sum[k] / count[k]).transpose().template cast<Scalar>();
        for (const int v : curve.regions[k]) out.radii[k] += (mesh.vertices.row(v) - out.nodes.row(row)).norm();
        out.radii[k] /= static_cast<Scalar>(curve.regions[k].size());
    }
    return out;
}

} // namespace skelgen
