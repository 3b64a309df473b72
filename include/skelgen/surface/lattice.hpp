#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include <skelgen/core/mesh.hpp>

namespace skelgen::surface {

/// A node of a lattice.
using LatticeNode = std::array<int, 3>;

/// Places on a regular grid.
template <typename Scalar = double>
struct Lattice {
    Vector3<Scalar> origin = Vector3<Scalar>::Zero();
    Scalar cell = 1;            ///< from one node to the next
    std::array<int, 3> nodes{}; ///< along each axis

    [[nodiscard]] Vector3<Scalar> place(const LatticeNode& node) const {
        return origin + cell * Vector3<Scalar>(static_cast<Scalar>(node[0]), static_cast<Scalar>(node[1]),
                                               static_cast<Scalar>(node[2]));
    }
    [[nodiscard]] bool has(const LatticeNode& node) const {
        for (std::size_t k = 0; k < 3; ++k)
            if (node[k] < 0 || node[k] >= nodes[k]) return false;
        return true;
    }
    [[nodiscard]] bool is_at_border(const LatticeNode& node) const {
        for (std::size_t k = 0; k < 3; ++k)
            if (node[k] == 0 || node[k] == nodes[k] - 1) return true;
        return false;
    }
};

/// Values at those nodes of a lattice that were given one; memory is taken for blocks of 8 x 8 x 8 around them.
template <typename Value>
class SparseGrid {
public:
    SparseGrid(const std::array<int, 3>& nodes, Value elsewhere) : elsewhere_(elsewhere) {
        std::size_t count = 1;
        for (std::size_t k = 0; k < 3; ++k) {
            blocks_along_[k] = static_cast<std::size_t>(nodes[k] + block_edge - 1) / block_edge;
            count *= blocks_along_[k];
        }
        blocks_.resize(count);
    }

    [[nodiscard]] Value get(const LatticeNode& node) const {
        const auto& block = blocks_[block_of(node)];
        return block ? (*block)[place_in_block(node)] : elsewhere_;
    }
    Value& at(const LatticeNode& node) {
        auto& block = blocks_[block_of(node)];
        if (!block) {
            block = std::make_unique<Block>();
            block->fill(elsewhere_);
        }
        return (*block)[place_in_block(node)];
    }

    /// Calls visit(node, value) at every node of the blocks in use, in a fixed order.
    template <typename Visit>
    void for_each(Visit&& visit) const {
        for (std::size_t b = 0; b < blocks_.size(); ++b) {
            if (!blocks_[b]) continue;
            const auto x = static_cast<int>(b % blocks_along_[0]) * block_edge,
                       y = static_cast<int>(b / blocks_along_[0] % blocks_along_[1]) * block_edge,
                       z = static_cast<int>(b / blocks_along_[0] / blocks_along_[1]) * block_edge;
            for (int i = 0; i < block_edge * block_edge * block_edge; ++i)
                visit(LatticeNode{x + i % block_edge, y + i / block_edge % block_edge, z + i / block_edge / block_edge},
                      (*blocks_[b])[static_cast<std::size_t>(i)]);
        }
    }

private:
    static constexpr int block_edge = 8;
    using Block = std::array<Value, static_cast<std::size_t>(block_edge) * block_edge * block_edge>;

    [[nodiscard]] std::size_t block_of(const LatticeNode& node) const {
        const auto block = [&](std::size_t k) { return static_cast<std::size_t>(node[k]) / block_edge; };
        return block(0) + blocks_along_[0] * (block(1) + blocks_along_[1] * block(2));
    }
    [[nodiscard]] static std::size_t place_in_block(const LatticeNode& node) {
        const auto place = [&](std::size_t k) { return static_cast<std::size_t>(node[k]) % block_edge; };
        return place(0) + block_edge * (place(1) + block_edge * place(2));
    }

    std::array<std::size_t, 3> blocks_along_{};
    std::vector<std::unique_ptr<Block>> blocks_;
    Value elsewhere_;
};

} // namespace skelgen::surface
