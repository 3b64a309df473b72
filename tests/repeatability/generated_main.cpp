// How right correspond, measure and segment are on generated bodies, whose truth is known by construction.

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

#include "generated_scores.hpp"
#include "printing.hpp"

namespace {

using namespace skelgen::repeatability;

void print(const GeneratedSet& set, bool with_measures) {
    std::printf("%s: %zu bodies, %zu without a skeleton\n", set.name.c_str(), set.bodies.size(), set.failures.size());
    for (const std::string& failure : set.failures) std::printf("  %s\n", failure.c_str());
    if (set.bodies.size() < 2) return;
    // Odd and no divisor of the sets' sizes: another figure in another pose, on a body of the next set where there are
    // two.
    print_correspondences(score_correspondences(set, 5));
    std::vector<const RegisteredBody*> bodies;
    for (const GeneratedBody& body : set.bodies) bodies.push_back(&body.found);
    print_borders(bodies);
    if (!with_measures) return;
    std::printf("  measure               against what the parameters give: mean, worst\n");
    for (const MeasureError& error : measure_errors(set))
        std::printf("    %-24s %4.1f %% %5.1f %%%s\n", error.name.c_str(), 100 * error.mean, 100 * error.worst,
                    error.without > 0 ? (", none on " + std::to_string(error.without)).c_str() : "");
}

} // namespace

int main(int argc, char** argv) {
    if (argc > 2) {
        std::fprintf(stderr, "usage: skelgen-generated-pairs [EVERY]\n");
        return 2;
    }
    try {
        const long every = argc == 2 ? std::strtol(argv[1], nullptr, 10) : 1;
        if (every < 1) {
            std::fprintf(stderr, "EVERY must be a number from 1\n");
            return 2;
        }
        const auto step = static_cast<std::size_t>(every);
        print(generate({"proportions"}, step), true);
        print(generate({"cartoon"}, step), true);
        print(generate({"partial"}, step), false);        // feet, hands, arms missing
        print(generate({"pieces", "scan"}, step), false); // characters on scans, and scans on characters
        print(generate({"faust"}, 4 * step), true);       // people
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
    return 0;
}
