// How alike align, segment, measure and correspond treat the bodies of a registered set, each turned at random.

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

#include "correspondences.hpp"
#include "pelvis.hpp"
#include "printing.hpp"
#include "registered_set.hpp"
#include "spreads.hpp"

namespace {

using namespace skelgen::repeatability;

void print_agreement(const RegisteredSet& set, const char* name, PartsOf parts) {
    const std::vector<double> same = agreements(set, parts);
    std::printf(
        "  segment --parts %-5s  same part: mean %.3f of the area, 5%% of the pairs below %.3f, worst %.3f; sides "
        "exchanged: at most %.4f\n",
        name, mean_of(same), quantile(same, 0.05), quantile(same, 0), worst_exchange(set, parts));
}

void print(const RegisteredSet& set) {
    std::printf("%s: %zu bodies, %zu without a skeleton\n", set.name.c_str(), set.bodies.size(), set.failures.size());
    for (const std::string& failure : set.failures) std::printf("  %s\n", failure.c_str());
    const std::vector<double> turns = pelvis_turns(set);
    std::printf(
        "  align                 pelvis turned against the medoid's: mean %.1f degrees, 95%% below %.1f, worst %.1f\n",
        mean_of(turns), quantile(turns, 0.95), quantile(turns, 1));
    print_agreement(set, "bones", &RegisteredBody::bones);
    print_agreement(set, "body", &RegisteredBody::body);
    std::vector<const RegisteredBody*> bodies;
    for (const RegisteredBody& body : set.bodies) bodies.push_back(&body);
    print_borders(bodies);
    print_correspondences(score_correspondences(set));
    std::printf("  measure               standard deviation over a person's bodies:\n");
    for (const auto& [name, spread] : measure_spreads(set))
        std::printf("    %-24s %4.1f %%\n", name.c_str(), 100 * spread);
}

} // namespace

int main(int argc, char** argv) {
    if (argc != 2 && argc != 3) {
        std::fprintf(stderr, "usage: skelgen-repeatability MESHES [EVERY]\n");
        return 2;
    }
    try {
        const long every = argc == 3 ? std::strtol(argv[2], nullptr, 10) : 1;
        if (every < 1) {
            std::fprintf(stderr, "EVERY must be a number from 1\n");
            return 2;
        }
        const std::vector<RegisteredSet> sets = load_sets(argv[1], static_cast<std::size_t>(every));
        if (sets.empty()) {
            std::fprintf(stderr, "%s: has no folder of meshes with equally many vertices\n", argv[1]);
            return 3;
        }
        for (const RegisteredSet& set : sets) print(set);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
    return 0;
}
