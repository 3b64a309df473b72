#include <algorithm>
#include <cstddef>
#include <random>
#include <vector>

#include <skelgen/core/min_cut.hpp>

#include "catch.hpp"

using namespace skelgen::core;

namespace {

struct Arc {
    std::size_t from, to;
    double there, back;
};

double cost_of(const std::vector<Arc>& arcs, const std::vector<bool>& is_first) {
    double cost = 0;
    for (const Arc& arc : arcs)
        if (is_first[arc.from] != is_first[arc.to]) cost += is_first[arc.from] ? arc.there : arc.back;
    return cost;
}

CutNetwork network_of(std::size_t nodes, const std::vector<Arc>& arcs) {
    CutNetwork network(nodes);
    for (const Arc& arc : arcs) network.join(arc.from, arc.to, arc.there, arc.back);
    return network;
}

} // namespace

TEST_CASE("a chain is cut at its cheapest arc, of several at the first") {
    const std::vector<Arc> chain{{0, 1, 5, 5}, {1, 2, 3, 3}, {2, 3, 4, 4}, {3, 4, 3, 3}};
    CHECK(network_of(5, chain).source_side(0, 4) == std::vector<bool>{true, true, false, false, false});
    CHECK(network_of(5, chain).source_side(4, 0) == std::vector<bool>{false, false, false, false, true});
}

TEST_CASE("what costs nothing the other way does not hold, and nodes apart stay with neither") {
    const std::vector<Arc> one_way{{0, 1, 0, 9}, {1, 2, 2, 0}};
    CHECK(network_of(4, one_way).source_side(0, 2) == std::vector<bool>{true, false, false, false});
    CHECK(network_of(4, one_way).source_side(2, 0) == std::vector<bool>{false, false, true, false});
}

TEST_CASE("the cut is the cheapest of all") {
    constexpr std::size_t nodes = 9;
    std::mt19937 random(7);
    std::uniform_int_distribution<std::size_t> node(0, nodes - 1);
    std::uniform_real_distribution<double> cost(0, 1);
    for (int network = 0; network < 50; ++network) {
        std::vector<Arc> arcs;
        for (int i = 0; i < 24; ++i)
            if (const std::size_t a = node(random), b = node(random); a != b)
                arcs.push_back({a, b, cost(random), cost(random)});
        double least = 1e9;
        for (unsigned way = 0; way < 1U << (nodes - 2); ++way) { // the source is node 0, the sink the last one
            std::vector<bool> is_first(nodes, false);
            is_first[0] = true;
            for (std::size_t v = 1; v + 1 < nodes; ++v) is_first[v] = (way >> (v - 1) & 1U) != 0;
            least = std::min(least, cost_of(arcs, is_first));
        }
        const std::vector<bool> found = network_of(nodes, arcs).source_side(0, nodes - 1);
        CHECK(found.front());
        CHECK_FALSE(found.back());
        CHECK(cost_of(arcs, found) == Approx(least).margin(1e-12));
    }
}
