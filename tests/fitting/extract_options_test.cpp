#include <utility>

#include <skelgen/fitting/extract_options.hpp>

#include "catch.hpp"

using namespace skelgen;

TEST_CASE("a first try has half as many vertices, but no fewer than a body's, and is held more firmly") {
    fitting::ExtractOptions options;
    const double weight = options.curve.contraction.medial_weight;
    for (const auto& [wanted, tried] : {std::pair(3000, 1500), std::pair(1600, 800), std::pair(1000, 750),
                                        std::pair(500, 500)}) { // who wants fewer gets these
        options.curve.proxy.vertices = wanted;
        const fitting::ExtractOptions first = fitting::for_first_try(options);
        CHECK(first.curve.proxy.vertices == tried);
        CHECK(first.curve.contraction.medial_weight == 5 * weight);
        CHECK(first.curve.is_draft);
        CHECK_NOTHROW(fitting::validate(first));
    }
    options.curve.contraction.medial_weight = 1e6; // the most that there may be
    CHECK_NOTHROW(fitting::validate(fitting::for_first_try(options)));
}
