#pragma once

#include <skelgen/surface/distance_band.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <skelgen/core/geometry.hpp>
#include <skelgen/surface/face_tree.hpp>

namespace skelgen::surface {
namespace detail {

template <typename Scalar>
using Corners = std::array<Vector3<Scalar>, 3>;

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
    for (int z = low[2]; z <= high[2]; ++z)
        for (int y = low[1]; y <= high[1]; ++y)
            for (int x = low[0]; x <= high[0]; ++x) {
                const LatticeNode node{x, y, z};
                const Scalar d = distance_to_triangle<Scalar>(lattice.place(node), t[0], t[1], t[2]);
                if (d > reach) continue;
                Scalar& least = distance.at(node);
                least = std::min(least, d);
            }
}

} // namespace detail

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

template <typename Scalar>
SparseGrid<Scalar> distance_band(const TriangleMesh<Scalar>& mesh, const Lattice<Scalar>& lattice, Scalar reach) {
    SparseGrid<Scalar> distance(lattice.nodes, std::numeric_limits<Scalar>::infinity());
    const Scalar longest = 8 * lattice.cell; // a large triangle's box would hold mostly nodes far from it
    std::vector<detail::Corners<Scalar>> pending;
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
        const auto corner = [&](int k) { return core::point(mesh.vertices, mesh.faces(f, k)); };
        pending.push_back({corner(0), corner(1), corner(2)});
        while (!pending.empty()) {
            const detail::Corners<Scalar> t = pending.back();
            pending.pop_back();
            std::size_t k = 0; // the longest edge, from corner k to the next
            const auto squared = [&](std::size_t i) { return (t[(i + 1) % 3] - t[i]).squaredNorm(); };
            for (std::size_t i = 1; i < 3; ++i)
                if (squared(i) > squared(k)) k = i;
            if (squared(k) <= longest * longest) {
                detail::lower_around(t, lattice, reach, distance);
                continue;
            }
            const Vector3<Scalar> middle = (t[k] + t[(k + 1) % 3]) / 2;
            pending.push_back({t[k], middle, t[(k + 2) % 3]});
            pending.push_back({middle, t[(k + 1) % 3], t[(k + 2) % 3]});
        }
    }
    return distance;
}

} // namespace skelgen::surface
