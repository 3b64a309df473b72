#pragma once

#include <skelgen/surface/envelope.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include <skelgen/core/geometry.hpp>
#include <skelgen/core/header_only.hpp>
#include <skelgen/core/options.hpp>
#include <skelgen/surface/denoise.hpp>
#include <skelgen/surface/distance_band.hpp>
#include <skelgen/surface/lattice_surface.hpp>
#include <skelgen/surface/small_parts.hpp>
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

/// The same surface in faces no longer than some cells, unless there would be too many: in the tree, a long face makes
/// a large ball of all that are beside it.
template <typename Scalar>
TriangleMesh<Scalar> in_small_faces(const TriangleMesh<Scalar>& mesh, Scalar cell) {
    constexpr Scalar longest_in_cells = 8;
    constexpr std::size_t most_parts = 2'000'000; // 200 MB
    std::vector<Corners<Scalar>> parts;
    bool too_many = false;
    for_each_small_part(mesh, longest_in_cells * cell, [&](const Corners<Scalar>& t) {
        too_many = too_many || parts.size() == most_parts;
        if (!too_many) parts.push_back(t);
    });
    if (too_many || parts.size() == static_cast<std::size_t>(mesh.faces.rows())) return mesh;
    TriangleMesh<Scalar> out;
    out.vertices.resize(3 * static_cast<Eigen::Index>(parts.size()), 3);
    out.faces.resize(static_cast<Eigen::Index>(parts.size()), 3);
    for (std::size_t i = 0; i < parts.size(); ++i)
        for (int k = 0; k < 3; ++k) {
            const auto row = 3 * static_cast<Eigen::Index>(i) + k;
            core::set_point<Scalar>(out.vertices, row, parts[i][static_cast<std::size_t>(k)]);
            out.faces(static_cast<Eigen::Index>(i), k) = static_cast<int>(row);
        }
    return out;
}

/// The edges at which a surface ends, as faces without area: those that its faces do not pass both ways alike.
template <typename Scalar>
TriangleMesh<Scalar> rims_of(const TriangleMesh<Scalar>& mesh) {
    std::vector<std::array<int, 3>> passes; // lower vertex, higher one, 1 upwards or -1
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int a = mesh.faces(f, k), b = mesh.faces(f, (k + 1) % 3);
            passes.push_back({std::min(a, b), std::max(a, b), a < b ? 1 : -1});
        }
    std::sort(passes.begin(), passes.end());
    TriangleMesh<Scalar> out{mesh.vertices, Triangles(static_cast<Eigen::Index>(passes.size()), 3)};
    Eigen::Index count = 0;
    for (std::size_t i = 0; i < passes.size();) {
        const auto [a, b, way] = passes[i];
        int sum = 0;
        for (; i < passes.size() && passes[i][0] == a && passes[i][1] == b; ++i) sum += passes[i][2];
        if (sum != 0) out.faces.row(count++) << a, b, b;
    }
    out.faces.conservativeResize(count, 3);
    return out;
}

/// Winding numbers at a lattice's nodes. Between two nodes of which no face lies, and far from the rims of holes, they
/// hardly differ: most nodes take theirs over from a neighbour.
template <typename Scalar>
class WindingField {
public:
    /// `distance`: of the nodes to the mesh, as far as a cell.
    WindingField(const TriangleMesh<Scalar>& mesh, const TriangleMesh<Scalar>& fine, const WindingTree<Scalar>& tree,
                 const Lattice<Scalar>& lattice, const SparseGrid<Scalar>& distance)
        : fine_(fine), tree_(tree), lattice_(lattice), distance_(distance),
          to_rim_(distance_band(rims_of(mesh), lattice, near_rim * lattice.cell)),
          known_(lattice.nodes, {std::numeric_limits<Scalar>::quiet_NaN(), 0}) {}

    /// The winding number less one half: positive inside.
    [[nodiscard]] Scalar depth(const LatticeNode& node) {
        if (std::isinf(to_rim_.get(node)))
            for (std::size_t axis = 0; axis < 3; ++axis)
                for (const int step : {-1, 1}) {
                    LatticeNode next = node;
                    next[axis] += step;
                    if (!lattice_.has(next)) continue;
                    const Known there = known_.get(next);
                    if (!(std::abs(there.depth) > clear) || there.steps == most_steps || may_be_parted(node, next))
                        continue;
                    known_.at(node) = {there.depth, there.steps + 1};
                    return there.depth;
                }
        const Scalar depth = tree_.winding_number(fine_, lattice_.place(node), far) - Scalar(0.5);
        known_.at(node) = {depth, 0};
        return depth;
    }

private:
    /// Beside a rim a winding number changes by 1 / (2 pi distance): over these steps, so far from it, by 0.16.
    static constexpr int most_steps = 2, near_rim = 2; // cells
    static constexpr Scalar clear = Scalar(0.3), far = Scalar(1.5);
    struct Known {
        Scalar depth; ///< not a number where it is not known
        int steps;    ///< from the node where it was found
    };

    /// May a face lie between two neighbours?
    [[nodiscard]] bool may_be_parted(const LatticeNode& a, const LatticeNode& b) const {
        constexpr Scalar rounded_up = Scalar(1.001);
        return distance_.get(a) + distance_.get(b) <= rounded_up * lattice_.cell;
    }

    const TriangleMesh<Scalar>& fine_;
    const WindingTree<Scalar>& tree_;
    const Lattice<Scalar>& lattice_;
    const SparseGrid<Scalar>& distance_;
    SparseGrid<Scalar> to_rim_; ///< infinite far from all rims
    SparseGrid<Known> known_;
};

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
    const TriangleMesh<Scalar> fine = detail::in_small_faces(mesh, detail::cell_size(mesh, options));
    const WindingTree<Scalar> tree(fine);
    const auto with_cells = [&](Scalar cell) {
        const Lattice<Scalar> lattice = lattice_around(mesh, cell, margin);
        const SparseGrid<Scalar> distance = distance_band(mesh, lattice, cell);
        detail::WindingField<Scalar> field(mesh, fine, tree, lattice, distance);
        LatticeShape<Scalar> shape;
        shape.depth = [&](const LatticeNode& node) { return field.depth(node); };
        shape.crossing = detail::crossing_by(distance, cell);
        return lattice_surface(lattice, detail::nodes_within(distance, cell), shape);
    };
    // At twice the cell a surface has a quarter of the faces; too many ask for larger cells.
    const Scalar cell = detail::cell_size(mesh, options);
    const double faces = 4 * static_cast<double>(with_cells(2 * cell).faces.rows());
    const double wider = std::sqrt(std::max(1.0, faces / options.most_faces));
    return smoothed(with_cells(cell * static_cast<Scalar>(wider)), options.smoothing_passes);
}

} // namespace skelgen::surface
