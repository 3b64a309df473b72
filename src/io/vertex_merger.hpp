#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include <skelgen/io/polygon_mesh.hpp>

#include "bit_cast.hpp"

namespace skelgen::io::detail {

/// Gives every position one index: a hash table with linear probing, a fraction of the time and memory that
/// std::unordered_map takes for millions of corners.
class VertexMerger {
public:
    explicit VertexMerger(PolygonMesh& mesh, std::size_t expected_vertices = 0)
        : mesh_(mesh), slots_(std::bit_ceil(std::max<std::size_t>(2 * expected_vertices + 1, 1024)), empty) {}

    void add_corner(std::array<double, 3> position) {
        for (double& coordinate : position) coordinate += 0.0; // -0 becomes 0
        if (2 * (mesh_.coordinates.size() / 3) >= slots_.size()) grow();
        int& slot = find(position.data());
        if (slot == empty) {
            slot = static_cast<int>(mesh_.coordinates.size() / 3);
            mesh_.coordinates.insert(mesh_.coordinates.end(), position.begin(), position.end());
        }
        mesh_.corners.push_back(slot);
    }

private:
    static constexpr int empty = -1;

    [[nodiscard]] const double* position(int vertex) const {
        return &mesh_.coordinates[3 * static_cast<std::size_t>(vertex)];
    }

    [[nodiscard]] static std::uint64_t hash(const double* p) {
        std::uint64_t h = 0;
        for (int axis = 0; axis < 3; ++axis) {
            h = (h ^ bit_cast<std::uint64_t>(p[axis])) * 0x9e3779b97f4a7c15U; // 2^64 / golden ratio
            h ^= h >> 32U;
        }
        return h;
    }

    /// The slot that holds this position, or the empty one where it belongs. Slots are a power of two in number.
    [[nodiscard]] int& find(const double* p) {
        const std::uint64_t mask = slots_.size() - 1;
        for (std::uint64_t i = hash(p) & mask;; i = (i + 1) & mask) {
            int& slot = slots_[i];
            if (slot == empty || std::equal(p, p + 3, position(slot))) return slot;
        }
    }

    void grow() {
        slots_.assign(4 * slots_.size(), empty);
        const int vertices = static_cast<int>(mesh_.coordinates.size() / 3);
        for (int vertex = 0; vertex < vertices; ++vertex) find(position(vertex)) = vertex;
    }

    PolygonMesh& mesh_;
    std::vector<int> slots_; ///< vertex indices or `empty`, at most half full
};

} // namespace skelgen::io::detail
