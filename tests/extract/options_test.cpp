// What is asked for: each option in its range, and refused with the range where it is not.

#include <cmath>
#include <string>

#include <skelgen/core/error.hpp>
#include <skelgen/extract.hpp>

#include "catch.hpp"
#include "shapes.hpp"

using namespace skelgen;
using namespace skelgen::test;

namespace {

/// What extract says to such options; empty where it takes them.
template <typename Edit>
std::string refusal(Edit&& edit) {
    ExtractOptions options;
    edit(options);
    try {
        static_cast<void>(extract(sphere(1, 3), options));
    } catch (const NoSkeleton&) {
        return {};
    } catch (const Error& error) {
        CHECK(error.code() == ErrorCode::usage);
        return error.what();
    }
    return {};
}

} // namespace

TEST_CASE("options out of their range are refused, with the range") {
    const std::string vertices = refusal([](auto& o) { o.curve.proxy.vertices = 0; });
    CHECK(vertices.find("option ") == 0);
    CHECK(vertices.find("is 0: it must be from ") != std::string::npos);
    CHECK_FALSE(refusal([](auto& o) { o.curve.contraction.iterations = -1; }).empty());
    CHECK_FALSE(refusal([](auto& o) { o.curve.contraction.laplacian_weight = std::nan(""); }).empty());
    CHECK_FALSE(refusal([](auto& o) { o.matching.distance_scale = 0; }).empty());
    CHECK_FALSE(refusal([](auto& o) { o.refinement.centreline.step = 0; }).empty());
    CHECK_FALSE(refusal([](auto& o) { o.refinement.head.slice = 0; }).empty());
    CHECK_FALSE(refusal([](auto& o) { o.prepare.denoise.most_passes = -1; }).empty());
}

TEST_CASE("a budget is a number of drafts from 1 to 1000, threads are from 1 to 1024") {
    for (const int budget : {0, -1, 1001}) {
        const std::string what = refusal([&](auto& o) { o.budget = budget; });
        CHECK_THAT(what, Catch::Matchers::StartsWith("option budget is " + std::to_string(budget)));
    }
    for (const int threads : {0, -1, 1025}) CHECK_FALSE(refusal([&](auto& o) { o.threads = threads; }).empty());
    CHECK(refusal([](auto& o) { o.budget = 1; }).empty());
    CHECK(refusal([](auto& o) { o.budget = 1000; }).empty());
}

TEST_CASE("what is left at its default is allowed") { CHECK_NOTHROW(validate(ExtractOptions{})); }
