#pragma once

#include <array>
#include <map>
#include <vector>

#include <skelgen/core/curve_skeleton.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/curve/impl/regions.hpp>

namespace skelgen::curve {

namespace detail {

/// Length-weighted mean displacement over one boundary loop of a region.
template <typename Scalar>
struct LoopDisplacement {
    Vector3<Scalar> weighted = Vector3<Scalar>::Zero();
    Scalar length = 0;
};

/// From (node, neighbour) to the boundary loop between their regions, on the node's side.
template <typename Scalar>
using BoundaryLoops = std::map<std::array<int, 2>, LoopDisplacement<Scalar>>;

template <typename Scalar>
BoundaryLoops<Scalar> boundary_loops(const CurveSkeleton<Scalar>& curve, const TriangleMesh<Scalar>& mesh,
                                     const Points<Scalar>& contracted) {
    const std::vector<int> node = node_of_vertex(curve, mesh.vertices.rows());
    BoundaryLoops<Scalar> loops;
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int u = mesh.faces(f, k), v = mesh.faces(f, (k + 1) % 3), w = mesh.faces(f, (k + 2) % 3);
            const int here = node[static_cast<std::size_t>(u)], there = node[static_cast<std::size_t>(w)];
            // An edge u-v within the region whose opposite corner lies in another one is part of that loop.
            if (node[static_cast<std::size_t>(v)] != here || there == here) continue;
            LoopDisplacement<Scalar>& loop = loops[{here, there}];
            const Scalar length = (core::point(mesh.vertices, u) - core::point(mesh.vertices, v)).norm();
            const Vector3<Scalar> displacement =
                Scalar(0.5) *
                (contracted.row(u) - mesh.vertices.row(u) + contracted.row(v) - mesh.vertices.row(v)).transpose();
            loop.weighted += length * displacement;
            loop.length += length;
        }
    return loops;
}

} // namespace detail

/// Embedding refinement (Au08 section 5): contraction drifts off centre; each node moves back by how far, on average
/// over the boundary loops of its region, the surface has been displaced. `mesh` is the mesh that was contracted,
/// `contracted` its contracted vertices, n x 3; the regions of `curve` index them, each vertex in exactly one. Leaves
/// have one loop, junctions three or more. Fills the radii. O(faces log k).
template <typename Scalar>
CurveSkeleton<Scalar> centre_nodes(const CurveSkeleton<Scalar>& curve, const TriangleMesh<Scalar>& mesh,
                                   const Points<Scalar>& contracted) {
    std::vector<Vector3<Scalar>> sum(curve.regions.size(), Vector3<Scalar>::Zero());
    std::vector<int> count(curve.regions.size(), 0);
    for (const auto& [key, loop] : detail::boundary_loops(curve, mesh, contracted)) {
        if (!(loop.length > 0)) continue;
        sum[static_cast<std::size_t>(key[0])] += loop.weighted / loop.length;
        ++count[static_cast<std::size_t>(key[0])];
    }
    CurveSkeleton<Scalar> out = curve;
    out.radii.assign(curve.regions.size(), Scalar(0));
    for (std::size_t k = 0; k < curve.regions.size(); ++k) {
        const auto row = static_cast<Eigen::Index>(k);
        const std::vector<int>& region = curve.regions[k];
        if (region.empty()) continue;
        // A region without an inner edge on its boundary (one vertex thick) takes the mean over its vertices instead.
        if (count[k] == 0) {
            for (const int v : region) sum[k] += (contracted.row(v) - mesh.vertices.row(v)).transpose();
            count[k] = static_cast<int>(region.size());
        }
        out.nodes.row(row) -= (sum[k] / static_cast<Scalar>(count[k])).transpose();
        for (const int v : region) out.radii[k] += (core::point(mesh.vertices, v) - core::point(out.nodes, row)).norm();
        out.radii[k] /= static_cast<Scalar>(region.size());
    }
    return out;
}

} // namespace skelgen::curve
