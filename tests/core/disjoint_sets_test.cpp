#include <skelgen/core/disjoint_sets.hpp>

#include <algorithm>
#include <random>
#include <vector>

#include "catch.hpp"

using skelgen::core::DisjointSets;

TEST_CASE("to begin with, each element is a set of its own") {
    DisjointSets sets(3);
    CHECK(sets.count() == 3);
    for (std::size_t i = 0; i < 3; ++i) CHECK(sets.find(i) == i);
    CHECK(DisjointSets(0).count() == 0);
}

TEST_CASE("joined sets are known by their lowest element, whatever the order in which they were joined") {
    DisjointSets sets(6);
    CHECK(sets.unite(5, 3));
    CHECK(sets.unite(4, 5));
    CHECK(sets.unite(1, 2));
    CHECK(sets.count() == 3);
    CHECK(sets.find(4) == 3);
    CHECK(sets.find(2) == 1);
    CHECK(sets.unite(4, 2));
    for (const std::size_t i : {1U, 2U, 3U, 4U, 5U}) CHECK(sets.find(i) == 1);
    CHECK(sets.find(0) == 0);
    CHECK(sets.count() == 2);
}

TEST_CASE("what is joined already stays as it is") {
    DisjointSets sets(3);
    CHECK_FALSE(sets.unite(1, 1));
    CHECK(sets.unite(0, 2));
    CHECK_FALSE(sets.unite(0, 2));
    CHECK_FALSE(sets.unite(2, 0));
    CHECK(sets.count() == 2);
}

TEST_CASE("a long chain is one set, and random pairs give the sets that relabelling gives") {
    constexpr std::size_t n = 200;
    DisjointSets chain(n);
    for (std::size_t i = n - 1; i > 0; --i) CHECK(chain.unite(i, i - 1));
    CHECK(chain.count() == 1);
    CHECK(chain.find(n - 1) == 0);

    DisjointSets sets(n);
    std::vector<std::size_t> label(n); // the lowest element of each one's set
    for (std::size_t i = 0; i < n; ++i) label[i] = i;
    std::mt19937 random(5);
    for (int pair = 0; pair < 150; ++pair) {
        const std::size_t a = random() % n, b = random() % n;
        const std::size_t low = std::min(label[a], label[b]), high = std::max(label[a], label[b]);
        CHECK(sets.unite(a, b) == (low != high));
        std::replace(label.begin(), label.end(), high, low);
    }
    for (std::size_t i = 0; i < n; ++i) CHECK(sets.find(i) == label[i]);
    std::sort(label.begin(), label.end());
    CHECK(sets.count() == static_cast<std::size_t>(std::unique(label.begin(), label.end()) - label.begin()));
}
