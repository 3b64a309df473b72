#pragma once

#include <skelgen/surface/envelope.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <skelgen/core/geometry.hpp>
#include <skelgen/core/header_only.hpp>
#include <skelgen/core/options.hpp>
#include <skelgen/surface/denoise.hpp>
#include <skelgen/surface/distance_band.hpp>
#include <skelgen/surface/lattice_surface.hpp>
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

/// Winding numbers at nodes, handed on from neighbours where that is safe: no face passes between them, and the number
/// is far from one half. What it changes by there is small, and after a few steps it is computed anew.
template <typename Scalar>
class NodeWindings {
public:
    NodeWindings(const TriangleMesh<Scalar>& mesh, const Lattice<Scalar>& lattice, const SparseGrid<Scalar>& distance)
        : mesh_(mesh), lattice_(lattice), distance_(distance), tree_(mesh), known_(lattice.nodes, Known{}) {}

    Scalar at(const LatticeNode& node) {
        Known& here = known_.at(node);
        for (std::size_t axis = 0; axis < 3; ++axis)
            for (const int step : {-1, 1}) {
                LatticeNode next = node;
                next[axis] += step;
                if (!lattice_.has(next)) continue;
                const Known there = known_.get(next);
                if (there.steps >= most_steps || std::abs(there.number - Scalar(0.5)) < safe) continue;
                if (distance_.get(node) + distance_.get(next) <= rounded_up * lattice_.cell) continue;
                here = {there.number, there.steps + 1};
                return here.number;
            }
        here = {tree_.winding_number(mesh_, lattice_.place(node)), 0};
        return here.number;
    }

private:
    static constexpr int most_steps = 12;
    static constexpr Scalar safe = Scalar(0.3), rounded_up = Scalar(1.001);
    struct Known {
        Scalar number = 0;
        int steps = most_steps;
    };
    const TriangleMesh<Scalar>& mesh_;
    const Lattice<Scalar>& lattice_;
    const SparseGrid<Scalar>& distance_;
    WindingTree<Scalar> tree_;
    SparseGrid<Known> known_;
};

} // namespace detail

SKELGEN_INLINE void validate(const EnvelopeOptions& options) {
    core::require_in_range("envelope.cells", options.cells, 10.0, 1000.0);
    core::require_in_range("envelope.smoothing_passes", options.smoothing_passes, 0, 100);
}

template <typename Scalar>
TriangleMesh<Scalar> winding_envelope(const TriangleMesh<Scalar>& mesh, const EnvelopeOptions& options) {
    validate(options);
    constexpr int margin = 3;
    const Scalar cell = detail::cell_size(mesh, options);
    const Lattice<Scalar> lattice = lattice_around(mesh, cell, margin);
    const SparseGrid<Scalar> distance = distance_band(mesh, lattice, cell);
    const WindingTree<Scalar> tree(mesh);
    LatticeShape<Scalar> shape;
    shape.depth = [&](const LatticeNode& node) { return tree.winding_number(mesh, lattice.place(node)) - Scalar(0.5); };
    shape.crossing = detail::crossing_by(distance, cell);
    return smoothed(lattice_surface(lattice, detail::nodes_within(distance, cell), shape), options.smoothing_passes);
}

namespace detail {

/// Distances from the places where a ball's middle can be, known near them alone.
template <typename Scalar>
class RollingBall {
public:
    /// `distance` to the faces, known up to two cells more than `radius`.
    RollingBall(const Lattice<Scalar>& lattice, const SparseGrid<Scalar>& distance, Scalar radius, Scalar reach)
        : lattice_(lattice), reach_(reach), free_(count(lattice), 0), distance_(distance), radius_(radius),
          nearest_(lattice.nodes, Nearest{{}, std::numeric_limits<Scalar>::infinity()}) {
        roll(distance, radius);
        spread();
    }

    /// From the nearest place of the ball's middle; 0 there, `reach` and more where it is farther.
    [[nodiscard]] Scalar distance(const LatticeNode& node) const {
        if (free_[index(node)] != 0) return 0;
        return std::min(nearest_.get(node).distance, 2 * reach_);
    }

private:
    struct Nearest {
        LatticeNode node{};
        Scalar distance = 0;
    };
    static std::size_t count(const Lattice<Scalar>& lattice) {
        return static_cast<std::size_t>(lattice.nodes[0]) * static_cast<std::size_t>(lattice.nodes[1]) *
               static_cast<std::size_t>(lattice.nodes[2]);
    }
    [[nodiscard]] std::size_t index(const LatticeNode& node) const {
        return static_cast<std::size_t>(node[0]) +
               static_cast<std::size_t>(lattice_.nodes[0]) *
                   (static_cast<std::size_t>(node[1]) +
                    static_cast<std::size_t>(lattice_.nodes[1]) * static_cast<std::size_t>(node[2]));
    }
    template <typename Visit>
    void visit_neighbours(const LatticeNode& node, Visit&& visit) const {
        for (std::size_t axis = 0; axis < 3; ++axis)
            for (const int step : {-1, 1}) {
                LatticeNode next = node;
                next[axis] += step;
                if (lattice_.has(next)) visit(next);
            }
    }

    /// How much nearer to the faces than a node at the rim the ball's middle can come.
    [[nodiscard]] Scalar spare(const LatticeNode& node) const {
        return std::min(distance_.get(node), radius_ + lattice_.cell) - radius_;
    }

    /// From a corner of the lattice through all places farther than `radius` from the faces.
    void roll(const SparseGrid<Scalar>& distance, Scalar radius) {
        std::vector<LatticeNode> pending{LatticeNode{0, 0, 0}};
        free_[0] = 1;
        while (!pending.empty()) {
            const LatticeNode node = pending.back();
            pending.pop_back();
            bool at_rim = false;
            visit_neighbours(node, [&](const LatticeNode& next) {
                if (free_[index(next)] != 0) return;
                if (distance.get(next) <= radius) {
                    at_rim = true;
                    return;
                }
                free_[index(next)] = 1;
                pending.push_back(next);
            });
            if (at_rim) rim_.push_back(node);
        }
        std::sort(rim_.begin(), rim_.end());
    }

    /// Hands on, from node to node, the nearest of the places at the rim.
    void spread() {
        std::vector<LatticeNode> layer = rim_;
        for (const LatticeNode& node : rim_) nearest_.at(node) = {node, -spare(node)};
        while (!layer.empty()) {
            std::vector<LatticeNode> next_layer;
            for (const LatticeNode& node : layer) {
                const LatticeNode source = nearest_.get(node).node;
                visit_neighbours(node, [&](const LatticeNode& next) {
                    if (free_[index(next)] != 0) return;
                    const Scalar d = (lattice_.place(next) - lattice_.place(source)).norm() - spare(source);
                    if (d > reach_ || d >= nearest_.get(next).distance) return;
                    nearest_.at(next) = {source, d};
                    next_layer.push_back(next);
                });
            }
            layer = std::move(next_layer);
        }
    }

    const Lattice<Scalar>& lattice_;
    Scalar reach_;
    std::vector<std::uint8_t> free_;
    const SparseGrid<Scalar>& distance_;
    Scalar radius_;
    SparseGrid<Nearest> nearest_;
    std::vector<LatticeNode> rim_;
};

} // namespace detail

template <typename Scalar>
TriangleMesh<Scalar> rolling_envelope(const TriangleMesh<Scalar>& mesh, const EnvelopeOptions& options) {
    validate(options);
    constexpr int margin = 6, radius_in_cells = 2;
    const Scalar cell = detail::cell_size(mesh, options), radius = radius_in_cells * cell;
    const Lattice<Scalar> lattice = lattice_around(mesh, cell, margin);
    const SparseGrid<Scalar> distance = distance_band(mesh, lattice, radius + 2 * cell);
    const detail::RollingBall<Scalar> ball(lattice, distance, radius, 2 * radius);
    LatticeShape<Scalar> shape;
    shape.depth = [&](const LatticeNode& node) { return ball.distance(node) - radius; };
    shape.crossing = detail::crossing_by(distance, cell);
    return smoothed(lattice_surface(lattice, detail::nodes_within(distance, radius), shape), options.smoothing_passes);
}

} // namespace skelgen::surface
