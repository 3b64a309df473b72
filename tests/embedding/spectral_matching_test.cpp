#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include <skelgen/core/error.hpp>
#include <skelgen/embedding/spectral_matching.hpp>

#include "catch.hpp"
#include "embedding/random_trees.hpp"
#include "mesh_changes.hpp"

using namespace skelgen;
using namespace skelgen::embedding;
using namespace skelgen::test;

namespace {

std::vector<int> in_order(const Tree& tree) {
    std::vector<int> order(tree.parent.size());
    std::iota(order.begin(), order.end(), 0);
    return order;
}

template <typename Scalar>
std::vector<int> match(const ReducedGraph<Scalar>& curve, const ReducedGraph<Scalar>& wanted) {
    const auto nodes = static_cast<int>(wanted.origin.size());
    return descend(curve, wanted, spectral_assignment(affinity_matrix(curve, wanted), nodes));
}

void check_is_injective(std::vector<int> partner, std::size_t candidates) {
    std::sort(partner.begin(), partner.end());
    CHECK(std::adjacent_find(partner.begin(), partner.end()) == partner.end());
    CHECK(partner.front() >= 0);
    CHECK(partner.back() < static_cast<int>(candidates));
}

/// Of 60 random trees, how many are found again node by node after `change`, which may add leaves at the end.
template <typename Scalar = double>
int recovered(void (*change)(Tree&, std::mt19937_64&)) {
    int count = 0;
    for (unsigned seed = 1; seed <= 60; ++seed) {
        std::mt19937_64 random(seed);
        const Tree tree = random_tree(2 + static_cast<int>(seed % 3), random);
        Tree changed = tree;
        change(changed, random);
        const std::vector<int> place = random_permutation(static_cast<int>(changed.parent.size()), random);
        const auto curve = graph_of<Scalar>(changed, place);
        const std::vector<int> partner = match(curve, graph_of<Scalar>(tree, in_order(tree)));
        REQUIRE(partner.size() == tree.parent.size());
        check_is_injective(partner, changed.parent.size());
        count += std::equal(partner.begin(), partner.end(), place.begin());
    }
    return count;
}

} // namespace

TEMPLATE_TEST_CASE("affinities are symmetric, not negative, and zero between pairs that exclude each other", "", float,
                   double) {
    std::mt19937_64 random(1);
    const Tree a = random_tree(3, random), b = random_tree(2, random);
    const Eigen::MatrixX<TestType> affinities =
        affinity_matrix(graph_of<TestType>(a, in_order(a)), graph_of<TestType>(b, in_order(b)));
    const auto m = static_cast<Eigen::Index>(a.parent.size()), n = static_cast<Eigen::Index>(b.parent.size());
    REQUIRE(affinities.rows() == m * n);
    REQUIRE(affinities.cols() == m * n);
    CHECK((affinities - affinities.transpose()).cwiseAbs().maxCoeff() == 0);
    CHECK(affinities.minCoeff() >= 0);
    for (Eigen::Index p = 0; p < m * n; ++p)
        for (Eigen::Index q = 0; q < m * n; ++q) {
            if (p == q) continue;
            const bool conflict = p / n == q / n || p % n == q % n;
            REQUIRE((affinities(p, q) == 0) == conflict);
        }
}

TEST_CASE("no pair is better than one whose degrees and distances agree") {
    std::mt19937_64 random(2);
    const Tree tree = random_tree(3, random);
    const ReducedGraph<double> graph = graph_of(tree, in_order(tree));
    const MatchingOptions options;
    const Eigen::MatrixXd affinities = affinity_matrix(graph, graph, options);
    const auto n = static_cast<Eigen::Index>(tree.parent.size());
    const double best = options.degree_weight + options.distance_weight;
    CHECK(affinities.maxCoeff() == Approx(best));
    for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index k = 0; k < n; ++k) REQUIRE(affinities(i * n + i, k * n + k) == Approx(best));
}

TEMPLATE_TEST_CASE("a planted match with its nodes in another order is found", "", float, double) {
    CHECK(recovered<TestType>([](Tree&, std::mt19937_64&) {}) == 60);
}

TEMPLATE_TEST_CASE("a planted match is found although lengths are wrong by up to 2 %", "", float, double) {
    CHECK(recovered<TestType>([](Tree& tree, std::mt19937_64& random) {
              for (double& length : tree.length) length *= uniform(random, 0.98, 1.02);
          }) >= 55);
}

TEST_CASE("a planted match is found among short leaves that have no partner") {
    CHECK(recovered([](Tree& tree, std::mt19937_64& random) {
              const auto nodes = static_cast<unsigned>(tree.parent.size());
              for (int leaf = 0; leaf < 2; ++leaf) {
                  tree.parent.push_back(static_cast<int>(random() % (nodes / 3)));
                  tree.length.push_back(uniform(random, 0.05, 0.12));
              }
          }) >= 50);
}

TEST_CASE("with fewer candidates than template nodes some stay without a partner") {
    std::mt19937_64 random(3);
    const Tree large = random_tree(3, random), small = random_tree(1, random);
    const auto nodes = static_cast<int>(large.parent.size());
    const std::vector<int> partner =
        spectral_assignment(affinity_matrix(graph_of(small, in_order(small)), graph_of(large, in_order(large))), nodes);
    REQUIRE(partner.size() == large.parent.size());
    CHECK(std::count(partner.begin(), partner.end(), -1) ==
          static_cast<long>(large.parent.size() - small.parent.size()));
}

TEST_CASE("descending repairs two partners that have been exchanged and leaves a right match alone") {
    std::mt19937_64 random(4);
    const Tree tree = random_tree(3, random);
    const ReducedGraph<double> graph = graph_of(tree, in_order(tree));
    const std::vector<int> right = in_order(tree);
    CHECK(descend(graph, graph, right) == right);
    for (std::size_t a = 0; a < right.size(); ++a)
        for (std::size_t b = a + 1; b < right.size(); ++b) {
            std::vector<int> wrong = right;
            std::swap(wrong[a], wrong[b]);
            INFO(a << " and " << b);
            CHECK(descend(graph, graph, wrong) == right);
        }
}

TEST_CASE("the least distorted match of a tree with itself is itself, wherever the search begins") {
    for (unsigned seed = 1; seed <= 10; ++seed) {
        std::mt19937_64 random(seed);
        const Tree tree = random_tree(2, random);
        const ReducedGraph<double> graph = graph_of(tree, in_order(tree));
        const std::vector<int> start = random_permutation(static_cast<int>(tree.parent.size()), random);
        INFO("seed " << seed);
        CHECK(least_distorted(graph, graph, start).partner == in_order(tree));
    }
}

TEST_CASE("no assignment of fewer distortion is missed: the search agrees with trying all") {
    std::mt19937_64 random(5);
    const Tree tree = random_tree(1, random);
    Tree longer = tree;
    for (double& length : longer.length) length *= uniform(random, 0.6, 1.6);
    const ReducedGraph<double> curve = graph_of(longer, in_order(longer)), wanted = graph_of(tree, in_order(tree));
    std::vector<int> all = in_order(tree);
    const std::vector<int> found = least_distorted(curve, wanted, all).partner;
    do CHECK(least_distorted(curve, wanted, all).partner == found); // as a start, none is better than what is found
    while (std::next_permutation(all.begin(), all.end()));
}

TEST_CASE("a search that would take too long is ended, says so, and returns nothing worse than its start") {
    // Nodes at random distances from each other: hardly any partial match is worse than the best one known.
    constexpr int nodes = 60, wanted_nodes = 9;
    std::mt19937_64 random(6);
    const auto random_graph = [&](int count) {
        ReducedGraph<double> graph;
        graph.distances = Eigen::MatrixXd::Zero(count, count);
        for (int i = 0; i < count; ++i) {
            graph.origin.push_back(i);
            graph.degree.push_back(1);
            graph.radius.push_back(0.0);
            for (int k = 0; k < i; ++k) graph.distances(i, k) = graph.distances(k, i) = uniform(random, 0.45, 0.55);
        }
        return graph;
    };
    const ReducedGraph<double> curve = random_graph(nodes), wanted = random_graph(wanted_nodes);
    std::vector<int> start(wanted_nodes);
    std::iota(start.begin(), start.end(), 0);
    const Assignment found = least_distorted(curve, wanted, start);
    CHECK_FALSE(found.is_least);
    CHECK(distortion(curve, wanted, found.partner) <= distortion(curve, wanted, start));

    const Tree tree = random_tree(2, random);
    CHECK(least_distorted(graph_of(tree, in_order(tree)), graph_of(tree, in_order(tree)), in_order(tree)).is_least);
}

TEMPLATE_TEST_CASE("what is assigned follows the leading eigenvector: of two candidates, the more affine one", "",
                   float, double) {
    // Four candidates for one template node: a diagonal matrix, whose eigenvectors are the axes.
    Eigen::MatrixX<TestType> affinities = Eigen::MatrixX<TestType>::Identity(4, 4);
    affinities(2, 2) = 3;
    CHECK(spectral_assignment(affinities, 1) == std::vector<int>{2});
}

TEST_CASE("options out of their range are refused by name") {
    const auto message_of = [](const MatchingOptions& options) -> std::string {
        try {
            validate(options);
        } catch (const Error& error) {
            CHECK(error.code() == ErrorCode::usage);
            return error.what();
        }
        return {};
    };
    CHECK(message_of({}).empty());
    for (const double wrong : {-1.0, 1e9, std::nan("")}) {
        const auto with = [&](double MatchingOptions::*member) {
            MatchingOptions options;
            options.*member = wrong;
            return options;
        };
        CHECK(message_of(with(&MatchingOptions::degree_weight)).find("matching.degree_weight") != std::string::npos);
        CHECK(message_of(with(&MatchingOptions::distance_weight)).find("matching.distance_weight") !=
              std::string::npos);
        CHECK(message_of(with(&MatchingOptions::distance_scale)).find("matching.distance_scale") != std::string::npos);
        CHECK(message_of(with(&MatchingOptions::radius_cost)).find("matching.radius_cost") != std::string::npos);
        CHECK(message_of(with(&MatchingOptions::degree_cost)).find("matching.degree_cost") != std::string::npos);
        CHECK(message_of(with(&MatchingOptions::end_cost)).find("matching.end_cost") != std::string::npos);
    }
    MatchingOptions no_scale;
    no_scale.distance_scale = 0; // would divide by it
    CHECK(message_of(no_scale).find("distance_scale") != std::string::npos);
}
