#pragma once

// Winding numbers at the nodes of a lattice, for envelopes (envelope.hpp).

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include <skelgen/surface/distance_band.hpp>
#include <skelgen/surface/lattice.hpp>
#include <skelgen/surface/winding_tree.hpp>

namespace skelgen::surface::detail {

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

/// Winding numbers at a lattice's nodes. Two neighbours with no face between them, far from the rims of holes, hardly
/// differ: most nodes take theirs over.
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
        const Scalar depth = tree_.winding_number(fine_, lattice_.place(node)) - Scalar(0.5);
        known_.at(node) = {depth, 0};
        return depth;
    }

private:
    /// Beside a rim a winding number changes by 1 / (2 pi distance): over these steps, so far from it, by 0.16.
    static constexpr int most_steps = 2, near_rim = 2; // cells
    static constexpr Scalar clear = Scalar(0.3);
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

} // namespace skelgen::surface::detail
