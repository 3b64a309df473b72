#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <skelgen/core/mesh.hpp>
#include <skelgen/surface/face_tree.hpp>
#include <skelgen/surface/lattice.hpp>
#include <skelgen/surface/small_parts.hpp>

namespace skelgen::surface {

namespace detail {

/// Those nodes of a row along x, from `first` on, that lie in a ball, or in none for rounding alone: the first and the
/// last x.
template <typename Scalar>
std::pair<int, int> nodes_in_ball(const LatticeNode& first, int last, const Lattice<Scalar>& lattice,
                                  const Vector3<Scalar>& centre, Scalar radius) {
    constexpr auto rounded_up = Scalar(1.001);
    const Vector3<Scalar> from = lattice.place(first) - centre;
    const Scalar squared = rounded_up * radius * radius - from[1] * from[1] - from[2] * from[2];
    if (!(squared >= 0)) return {0, -1};
    const Scalar half = std::sqrt(squared);
    return {first[0] + std::max(0, static_cast<int>(std::ceil((-from[0] - half) / lattice.cell))),
            std::min(last, first[0] + static_cast<int>(std::floor((-from[0] + half) / lattice.cell)))};
}

/// Lowers the distances around one triangle.
template <typename Scalar>
void lower_around(const Corners<Scalar>& t, const Lattice<Scalar>& lattice, Scalar reach,
                  SparseGrid<Scalar>& distance) {
    LatticeNode low{}, high{};
    for (std::size_t k = 0; k < 3; ++k) {
        const auto axis = static_cast<Eigen::Index>(k);
        const auto [least, most] = std::minmax({t[0][axis], t[1][axis], t[2][axis]});
        const Scalar from = (least - reach - lattice.origin[axis]) / lattice.cell,
                     to = (most + reach - lattice.origin[axis]) / lattice.cell;
        low[k] = std::max(0, static_cast<int>(std::ceil(from)));
        high[k] = std::min(lattice.nodes[k] - 1, static_cast<int>(std::floor(to)));
    }
    // Most nodes of the box are farther from the triangle's plane, or from the ball around it, than they know a face.
    const Vector3<Scalar> normal = (t[1] - t[0]).cross(t[2] - t[0]).normalized(), centre = (t[0] + t[1] + t[2]) / 3;
    const Scalar offset = normal.dot(t[0]);
    const Scalar radius = std::sqrt(
        std::max({(t[0] - centre).squaredNorm(), (t[1] - centre).squaredNorm(), (t[2] - centre).squaredNorm()}));
    for (int z = low[2]; z <= high[2]; ++z)
        for (int y = low[1]; y <= high[1]; ++y) {
            const auto [first, last] = nodes_in_ball({low[0], y, z}, high[0], lattice, centre, reach + radius);
            for (int x = first; x <= last; ++x) {
                const LatticeNode node{x, y, z};
                const Vector3<Scalar> place = lattice.place(node);
                const Scalar known = std::min(distance.get(node), reach);
                if (std::abs(normal.dot(place) - offset) > known) continue;
                if ((place - centre).squaredNorm() > (known + radius) * (known + radius)) continue;
                const Scalar d = distance_to_triangle<Scalar>(place, t[0], t[1], t[2]);
                if (d <= known) distance.at(node) = d;
            }
        }
}

} // namespace detail

/// A lattice around a mesh with `margin` cells to spare on each side.
template <typename Scalar>
Lattice<Scalar> lattice_around(const TriangleMesh<Scalar>& mesh, Scalar cell, int margin) {
    Lattice<Scalar> out;
    out.cell = cell;
    // Places on a face are neither inside nor outside: the nodes keep off those of boxes.
    const Vector3<Scalar> askew(Scalar(0.37), Scalar(0.29), Scalar(0.43));
    for (int k = 0; k < 3; ++k) {
        const Scalar low = mesh.vertices.col(k).minCoeff(), high = mesh.vertices.col(k).maxCoeff();
        out.origin[k] = low - (static_cast<Scalar>(margin) + askew[k]) * cell;
        out.nodes[static_cast<std::size_t>(k)] = static_cast<int>(std::ceil((high - low) / cell)) + 2 * margin + 2;
    }
    return out;
}

/// Distances to the nearest face at the lattice's nodes up to `reach` from one; infinity at the others. O(area of the
/// faces in cells, but at least one for each face, times the nodes within reach).
template <typename Scalar>
SparseGrid<Scalar> distance_band(const TriangleMesh<Scalar>& mesh, const Lattice<Scalar>& lattice, Scalar reach) {
    SparseGrid<Scalar> distance(lattice.nodes, std::numeric_limits<Scalar>::infinity());
    const Scalar longest = 8 * lattice.cell; // a large triangle's box would hold mostly nodes far from it
    for_each_small_part(mesh, longest,
                        [&](const Corners<Scalar>& t) { detail::lower_around(t, lattice, reach, distance); });
    return distance;
}

} // namespace skelgen::surface
