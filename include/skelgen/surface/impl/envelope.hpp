#pragma once

#include <skelgen/surface/envelope.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <skelgen/core/geometry.hpp>
#include <skelgen/core/header_only.hpp>
#include <skelgen/core/options.hpp>
#include <skelgen/surface/denoise.hpp>
#include <skelgen/surface/impl/distance_band.hpp>
#include <skelgen/surface/lattice_surface.hpp>
#include <skelgen/surface/winding_field.hpp>
#include <skelgen/surface/winding_tree.hpp>

namespace skelgen::surface {
namespace detail {

template <typename Scalar>
Scalar cell_size(const TriangleMesh<Scalar>& mesh, const EnvelopeOptions& options) {
    const Scalar longest = (mesh.vertices.colwise().maxCoeff() - mesh.vertices.colwise().minCoeff()).maxCoeff();
    return longest / static_cast<Scalar>(options.cells);
}

/// Nodes within a distance.
template <typename Scalar>
std::vector<LatticeNode> nodes_within(const SparseGrid<Scalar>& distance, Scalar reach) {
    std::vector<LatticeNode> out;
    distance.for_each([&](const LatticeNode& node, Scalar d) {
        if (d <= reach) out.push_back(node);
    });
    return out;
}

/// Where a surface passes between two neighbours: where a face does, known by their distances to it, if one does at
/// all, and else, across a hole, where the depth is zero.
template <typename Scalar>
auto crossing_by(const SparseGrid<Scalar>& distance, Scalar cell) {
    return [&distance, cell](const LatticeNode& in, const LatticeNode& out, Scalar depth_in, Scalar depth_out) {
        const Scalar d_in = distance.get(in), d_out = distance.get(out), sum = d_in + d_out;
        constexpr Scalar rounded_up = Scalar(1.001);
        if (sum <= rounded_up * cell) return sum > 0 ? d_in / sum : Scalar(0.5);
        return std::clamp(depth_in / (depth_in - depth_out), Scalar(0), Scalar(1));
    };
}

} // namespace detail

SKELGEN_INLINE void validate(const EnvelopeOptions& options) {
    core::require_in_range("envelope.cells", options.cells, 10.0, 1000.0);
    core::require_in_range("envelope.most_faces", options.most_faces, 1000, 10'000'000);
    core::require_in_range("envelope.smoothing_passes", options.smoothing_passes, 0, 100);
}

template <typename Scalar>
TriangleMesh<Scalar> winding_envelope(const TriangleMesh<Scalar>& mesh, const EnvelopeOptions& options) {
    validate(options);
    constexpr int margin = 3;
    const TriangleMesh<Scalar> caps = detail::caps_of(mesh);
    const WindingTree<Scalar> tree(caps);
    const auto with_cells = [&](Scalar cell) {
        const Lattice<Scalar> lattice = lattice_around(mesh, cell, margin);
        const SparseGrid<Scalar> distance = distance_band(mesh, lattice, cell);
        const detail::WindingField<Scalar> field(mesh, caps, tree, lattice);
        LatticeShape<Scalar> shape;
        shape.depth = [&](const LatticeNode& node) { return field.depth(node); };
        shape.crossing = detail::crossing_by(distance, cell);
        return lattice_surface(lattice, detail::nodes_within(distance, cell), shape);
    };
    // A roughly drawn surface tells how many faces there will be; too many ask for larger cells.
    constexpr int rough = 4; // cells in one
    const Scalar cell = detail::cell_size(mesh, options);
    const double faces = rough * rough * static_cast<double>(with_cells(rough * cell).faces.rows());
    const double wider = std::sqrt(std::max(1.0, faces / options.most_faces));
    return smoothed(with_cells(cell * static_cast<Scalar>(wider)), options.smoothing_passes);
}

} // namespace skelgen::surface
