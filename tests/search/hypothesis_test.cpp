#include <array>
#include <set>
#include <string_view>
#include <utility>

#include <skelgen/search/hypothesis.hpp>

#include "catch.hpp"

using namespace skelgen;
using namespace skelgen::search;

namespace {

constexpr std::array efforts{Effort::draft, Effort::detailed, Effort::more_detailed, Effort::rest_fit,
                             Effort::posed_fit};

/// How many different spellings these values have, empty ones not counted.
template <typename Values>
std::size_t spellings(const Values& values) {
    std::set<std::string_view> names;
    for (const auto value : values) names.insert(to_string(value));
    names.erase("");
    return names.size();
}

} // namespace

TEST_CASE("a draft has half as many vertices, but no fewer than a body's, and is held more firmly") {
    curve::CurveOptions options;
    const double weight = options.contraction.medial_weight;
    for (const auto& [wanted, tried] : {std::pair(3000, 1500), std::pair(1600, 800), std::pair(1000, 750),
                                        std::pair(500, 500)}) { // who wants fewer gets these
        options.proxy.vertices = wanted;
        const curve::CurveOptions draft = curve_options(Effort::draft, options);
        CHECK(draft.proxy.vertices == tried);
        CHECK(draft.contraction.medial_weight == 5 * weight);
        CHECK(draft.is_draft);
    }
}

TEST_CASE("whatever is allowed to be wanted, every effort's options are allowed, too") {
    curve::CurveOptions least, most;
    least.proxy.vertices = 100;
    most.proxy.vertices = curve::most_proxy_vertices;
    most.contraction.medial_weight = 1e6;
    for (const curve::CurveOptions& options : {curve::CurveOptions{}, least, most}) {
        REQUIRE_NOTHROW(curve::validate(options));
        for (const Effort effort : efforts) {
            INFO(to_string(effort));
            CHECK_NOTHROW(curve::validate(curve_options(effort, options)));
        }
    }
}

TEST_CASE("a curve costs a draft or more, and the more the finer it is") {
    for (const Effort effort : efforts) CHECK((cost_of(effort) >= 1 || effort == Effort::posed_fit));
    CHECK(cost_of(Effort::posed_fit) == 0); // is always tried last, and needs no curve
    for (const Effort effort : {Effort::detailed, Effort::more_detailed}) {
        const curve::CurveOptions detailed = curve_options(effort, {}), wanted;
        CHECK(detailed.is_draft);
        CHECK(detailed.pruning.branch < wanted.pruning.branch);
        CHECK(detailed.proxy.vertices == (effort == Effort::detailed ? 1 : 3) * wanted.proxy.vertices);
    }
    CHECK(cost_of(Effort::draft) == 1);
    CHECK(cost_of(Effort::draft) < cost_of(Effort::detailed));
    CHECK(cost_of(Effort::detailed) < cost_of(Effort::more_detailed));
}

TEST_CASE("every part of a hypothesis has a name of its own, as trails spell it") {
    using surface::Remedy;
    CHECK(spellings(efforts) == efforts.size());
    CHECK(spellings(std::array{Remedy::largest_piece, Remedy::envelope, Remedy::rounded, Remedy::alike_pieces,
                               Remedy::bridged}) == 5);
    CHECK(to_string(Remedy::largest_piece) == "largest_piece");
}

TEST_CASE("what is assumed first is the gentlest: a draft of the largest piece") {
    constexpr Hypothesis first;
    CHECK(first.surface == surface::Remedy::largest_piece);
    CHECK(first.effort == Effort::draft);
}
