// The quick first try of a body's curve: enough where it is sure, and without effect where it is not.

#include <skelgen/curve/find_curve.hpp>
#include <skelgen/extract.hpp>
#include <skelgen/fitting/extract_options.hpp>
#include <skelgen/surface/body.hpp>
#include <skelgen/surface/prepare.hpp>

#include "catch.hpp"
#include "fixture_bodies.hpp"

using namespace skelgen;
using namespace skelgen::test;

namespace {

/// Whether two curves are the same: as many nodes, at the same places.
bool is_same(const CurveSkeleton<double>& a, const CurveSkeleton<double>& b) {
    return a.nodes.rows() == b.nodes.rows() && (a.nodes - b.nodes).cwiseAbs().maxCoeff() < 1e-9;
}

} // namespace

TEST_CASE("a body that is found surely has the curve of the first try") {
    for (const char* name : {"standing-man", "walking-woman"}) {
        INFO(name);
        const FixtureBody known = load_fixture_body(name);
        const Extraction<double> found = extract_skeleton(known.mesh);
        const Body<double> body = prepare(known.mesh);
        const auto first = find_curve(body, fitting::for_first_try({}).curve).curve;
        const auto whole = find_curve(body).curve;
        CHECK(found.skeleton.quality.sides_confidence > 0.5);
        CHECK(is_same(found.curve, surface::to_input(body, first)));
        CHECK_FALSE(is_same(found.curve, surface::to_input(body, whole)));
    }
}

TEST_CASE("a body that is hardly found has the curve that was asked for") {
    const FixtureBody figure = load_fixture_body("figure"); // its odd proportions cost confidence
    const Extraction<double> found = extract_skeleton(figure.mesh);
    const Body<double> body = prepare(figure.mesh);
    CHECK(found.skeleton.quality.sides_confidence <= 0.5);
    CHECK(is_same(found.curve, surface::to_input(body, find_curve(body).curve)));
}
