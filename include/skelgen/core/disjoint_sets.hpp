#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace skelgen::core {

/// A partition of 0, 1, ..., n - 1 whose sets are joined two by two: union-find with path halving. To begin with, each
/// element is a set of its own. Fewer than 2^32 elements.
class DisjointSets {
public:
    /// O(n).
    explicit DisjointSets(std::size_t n) : parent_(n), count_(n) {
        std::iota(parent_.begin(), parent_.end(), std::uint32_t{0});
    }

    /// How many sets there are. O(1).
    [[nodiscard]] std::size_t count() const { return count_; }

    /// The lowest element of the set that `i` is in; `i` must be below n. O(log n) on average over many calls.
    [[nodiscard]] std::size_t find(std::size_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }

    /// Joins the sets of two elements, both below n. \returns whether they were two. As `find`.
    bool unite(std::size_t a, std::size_t b) {
        a = find(a);
        b = find(b);
        if (a == b) return false;
        parent_[std::max(a, b)] = static_cast<std::uint32_t>(std::min(a, b));
        --count_;
        return true;
    }

private:
    std::vector<std::uint32_t> parent_;
    std::size_t count_;
};

} // namespace skelgen::core
