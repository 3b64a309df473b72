#pragma once

#include <skelgen/surface/lattice_surface.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include <skelgen/core/geometry.hpp>

namespace skelgen::surface {
namespace detail {

inline LatticeNode moved_by(LatticeNode node, std::size_t axis, int steps) {
    node[axis] += steps;
    return node;
}

/// Which corners of a cell are inside, corner i at (i & 1, i >> 1 & 1, i >> 2), and does the border pass it so that its
/// inside or its outside hangs together by an edge or a corner alone?
inline bool is_pinched(unsigned inside) {
    const auto is_in = [&](unsigned corner) { return (inside >> corner & 1U) != 0; };
    for (unsigned axis = 0; axis < 3; ++axis) {
        const unsigned u = 1U << (axis + 1) % 3, v = 1U << (axis + 2) % 3;
        for (unsigned side = 0; side < 2; ++side) {
            const unsigned base = side << axis;
            if (is_in(base) == is_in(base | u | v) && is_in(base | u) == is_in(base | v) &&
                is_in(base) != is_in(base | u))
                return true;
        }
    }
    for (unsigned corner = 0; corner < 4; ++corner) {
        const unsigned both = 1U << corner | 1U << (7 - corner);
        if (inside == both || inside == (0xFFU & ~both)) return true;
    }
    return false;
}

/// That of all ways in which corners can be inside.
inline std::array<bool, 256> pinched_cells() {
    std::array<bool, 256> out{};
    for (unsigned inside = 0; inside < out.size(); ++inside) out[inside] = is_pinched(inside);
    return out;
}

/// The nodes around the border of a shape, each known to be inside or outside.
template <typename Scalar>
class LatticeBorder {
public:
    LatticeBorder(const Lattice<Scalar>& lattice, const LatticeShape<Scalar>& shape)
        : lattice_(lattice), shape_(shape), depth_(lattice.nodes, std::numeric_limits<Scalar>::quiet_NaN()) {}

    /// Follows the border from these nodes on: all corners of all cells that it passes become known.
    void follow(const std::vector<LatticeNode>& seeds) {
        for (const LatticeNode& seed : seeds) learn(seed);
        follow_on();
    }

    /// Takes nodes out of the inside until no cell is pinched.
    void unpinch() {
        std::vector<LatticeNode> cells; // their lowest corners
        for (std::size_t i = 0; i < known_.size(); ++i) append_cells_around(known_[i], cells);
        while (!cells.empty()) {
            const LatticeNode cell = cells.back();
            cells.pop_back();
            while (is_pinched_at(cell)) {
                const LatticeNode shallowest = shallowest_corner(cell);
                Scalar& depth = depth_.at(shallowest);
                depth = -std::max(depth, std::numeric_limits<Scalar>::min());
                pending_.push_back(shallowest);
                follow_on();
                append_cells_around(shallowest, cells);
            }
        }
    }

    TriangleMesh<Scalar> surface() {
        SparseGrid<int> vertex_of_cell(lattice_.nodes, -1);
        std::vector<Vector3<Scalar>> sums;
        std::vector<int> counts;
        std::vector<std::array<int, 4>> quads;
        for (std::size_t i = 0; i < known_.size(); ++i)
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const LatticeNode a = known_[i], b = moved_by(a, axis, 1);
                if (!is_crossed(a, b)) continue;
                const bool outwards = is_inside(a); // along the axis
                const LatticeNode &in = outwards ? a : b, &out = outwards ? b : a;
                const Scalar t = shape_.crossing(in, out, depth_.get(in), depth_.get(out));
                const Vector3<Scalar> crossing = (1 - t) * lattice_.place(in) + t * lattice_.place(out);
                std::array<int, 4> quad{};
                for (std::size_t c = 0; c < 4; ++c) {
                    constexpr std::array<std::array<int, 2>, 4> around{{{-1, -1}, {0, -1}, {0, 0}, {-1, 0}}};
                    LatticeNode cell = a;
                    cell[(axis + 1) % 3] += around[c][0];
                    cell[(axis + 2) % 3] += around[c][1];
                    int& vertex = vertex_of_cell.at(cell);
                    if (vertex < 0) {
                        vertex = static_cast<int>(sums.size());
                        sums.emplace_back(Vector3<Scalar>::Zero());
                        counts.push_back(0);
                    }
                    sums[static_cast<std::size_t>(vertex)] += crossing;
                    ++counts[static_cast<std::size_t>(vertex)];
                    quad[outwards ? c : 3 - c] = vertex;
                }
                quads.push_back(quad);
            }
        TriangleMesh<Scalar> out;
        out.vertices.resize(static_cast<Eigen::Index>(sums.size()), 3);
        for (std::size_t v = 0; v < sums.size(); ++v)
            core::set_point<Scalar>(out.vertices, static_cast<Eigen::Index>(v),
                                    sums[v] / static_cast<Scalar>(counts[v]));
        out.faces.resize(2 * static_cast<Eigen::Index>(quads.size()), 3);
        const auto squared = [&](int a, int b) {
            return (core::point(out.vertices, a) - core::point(out.vertices, b)).squaredNorm();
        };
        for (std::size_t i = 0; i < quads.size(); ++i) {
            const auto [a, b, c, d] = quads[i];
            const auto row = 2 * static_cast<Eigen::Index>(i);
            if (squared(a, c) <= squared(b, d)) {
                out.faces.row(row) << a, b, c;
                out.faces.row(row + 1) << a, c, d;
            } else {
                out.faces.row(row) << a, b, d;
                out.faces.row(row + 1) << b, c, d;
            }
        }
        return out;
    }

private:
    [[nodiscard]] bool is_known_node(const LatticeNode& node) const { return !std::isnan(depth_.get(node)); }
    [[nodiscard]] bool is_inside(const LatticeNode& node) const { return depth_.get(node) > 0; }

    /// Does the border pass between a node and a neighbour, if that is known?
    [[nodiscard]] bool is_crossed(const LatticeNode& node, const LatticeNode& neighbour) const {
        return lattice_.has(neighbour) && is_known_node(neighbour) && is_inside(node) != is_inside(neighbour);
    }

    void learn(const LatticeNode& node) {
        if (!lattice_.has(node) || is_known_node(node)) return;
        depth_.at(node) = lattice_.is_at_border(node) ? Scalar(-1) : shape_.depth(node);
        known_.push_back(node);
        pending_.push_back(node);
    }

    void follow_on() {
        while (!pending_.empty()) {
            const LatticeNode node = pending_.back();
            pending_.pop_back();
            for (std::size_t axis = 0; axis < 3; ++axis)
                for (const int step : {-1, 1}) {
                    const LatticeNode next = moved_by(node, axis, step);
                    if (!is_crossed(node, next)) continue;
                    for (const LatticeNode& end : {node, next})
                        for (int u = -1; u <= 1; ++u)
                            for (int v = -1; v <= 1; ++v)
                                learn(moved_by(moved_by(end, (axis + 1) % 3, u), (axis + 2) % 3, v));
                }
        }
    }

    /// The eight cells that have this corner.
    void append_cells_around(const LatticeNode& node, std::vector<LatticeNode>& cells) const {
        for (int i = 0; i < 8; ++i) {
            const LatticeNode cell{node[0] - (i & 1), node[1] - (i >> 1 & 1), node[2] - (i >> 2)};
            if (lattice_.has(cell)) cells.push_back(cell);
        }
    }
    static LatticeNode corner_of(const LatticeNode& cell, unsigned i) {
        return {cell[0] + static_cast<int>(i & 1U), cell[1] + static_cast<int>(i >> 1 & 1U),
                cell[2] + static_cast<int>(i >> 2)};
    }
    /// Are all corners of a cell known, and is it pinched?
    [[nodiscard]] bool is_pinched_at(const LatticeNode& cell) const {
        static const std::array<bool, 256> pinched = pinched_cells();
        if (!lattice_.has(corner_of(cell, 7))) return false;
        unsigned inside = 0;
        for (unsigned i = 0; i < 8; ++i) {
            const Scalar depth = depth_.get(corner_of(cell, i));
            if (std::isnan(depth)) return false;
            if (depth > 0) inside |= 1U << i;
        }
        return pinched[inside];
    }
    [[nodiscard]] LatticeNode shallowest_corner(const LatticeNode& cell) const {
        LatticeNode best = cell;
        Scalar least = std::numeric_limits<Scalar>::infinity();
        for (unsigned i = 0; i < 8; ++i) {
            const LatticeNode corner = corner_of(cell, i);
            const Scalar depth = depth_.get(corner);
            if (!(depth > 0) || depth >= least) continue;
            least = depth;
            best = corner;
        }
        return best;
    }

    const Lattice<Scalar>& lattice_;
    const LatticeShape<Scalar>& shape_;
    SparseGrid<Scalar> depth_; ///< NaN where it is not known
    std::vector<LatticeNode> known_, pending_;
};

} // namespace detail

template <typename Scalar>
TriangleMesh<Scalar> lattice_surface(const Lattice<Scalar>& lattice, const std::vector<LatticeNode>& seeds,
                                     const LatticeShape<Scalar>& shape) {
    detail::LatticeBorder<Scalar> border(lattice, shape);
    border.follow(seeds);
    border.unpinch();
    return border.surface();
}

} // namespace skelgen::surface
