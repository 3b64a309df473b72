#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <Eigen/Core>

#include <skelgen/embedding/reduced_graph.hpp>

namespace skelgen::test {

/// A tree with lengths on its edges; parents before children.
struct Tree {
    std::vector<int> parent;    ///< -1 for the root
    std::vector<double> length; ///< of the edge to the parent
};

inline double uniform(std::mt19937_64& random, double low, double high) {
    return low + (high - low) * std::ldexp(static_cast<double>(random() >> 11), -53);
}

/// A tree of `junctions` inner nodes, each with three branches or more, and at least `junctions` + 2 leaves.
inline Tree random_tree(int junctions, std::mt19937_64& random) {
    Tree tree{{-1}, {0}};
    const auto grow = [&](int parent) {
        tree.parent.push_back(parent);
        tree.length.push_back(uniform(random, 0.2, 1));
    };
    for (int j = 1; j < junctions; ++j) grow(static_cast<int>(random() % static_cast<unsigned>(j)));
    std::vector<int> degree(tree.parent.size(), 0);
    for (std::size_t v = 1; v < tree.parent.size(); ++v) {
        ++degree[v];
        ++degree[static_cast<std::size_t>(tree.parent[v])];
    }
    for (int j = 0; j < junctions; ++j) {
        const int leaves = std::max(3 - degree[static_cast<std::size_t>(j)], 1) + static_cast<int>(random() % 2);
        for (int leaf = 0; leaf < leaves; ++leaf) grow(j);
    }
    return tree;
}

/// The tree as the matching sees it; node i of the tree becomes node `place`[i].
template <typename Scalar = double>
embedding::ReducedGraph<Scalar> graph_of(const Tree& tree, const std::vector<int>& place) {
    const auto n = static_cast<Eigen::Index>(tree.parent.size());
    Eigen::MatrixXd distances = Eigen::MatrixXd::Zero(n, n);
    for (Eigen::Index v = 1; v < n; ++v)
        for (Eigen::Index u = 0; u < v; ++u)
            distances(u, v) = distances(v, u) =
                distances(u, tree.parent[static_cast<std::size_t>(v)]) + tree.length[static_cast<std::size_t>(v)];
    embedding::ReducedGraph<Scalar> graph;
    graph.origin.resize(tree.parent.size());
    graph.degree.assign(tree.parent.size(), 0);
    graph.radius.assign(tree.parent.size(), 0);
    graph.distances.resize(n, n);
    for (std::size_t v = 0; v < tree.parent.size(); ++v) {
        const auto here = static_cast<std::size_t>(place[v]);
        graph.origin[here] = place[v];
        if (v > 0) {
            ++graph.degree[here];
            ++graph.degree[static_cast<std::size_t>(place[static_cast<std::size_t>(tree.parent[v])])];
        }
        for (std::size_t u = 0; u < tree.parent.size(); ++u)
            graph.distances(place[v], place[u]) = static_cast<Scalar>(
                distances(static_cast<Eigen::Index>(v), static_cast<Eigen::Index>(u)) / distances.maxCoeff());
    }
    return graph;
}

} // namespace skelgen::test
