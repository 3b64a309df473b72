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

TEST_CASE("a body that is found surely has the curve of the first try, made whole") {
    for (const char* name : {"standing-man", "walking-woman"}) {
        INFO(name);
        const FixtureBody known = load_fixture_body(name);
        const Extraction<double> found = extract_skeleton(known.mesh);
        const Body<double> body = prepare(known.mesh);
        const auto first = finished(find_curve(body, fitting::for_first_try({}).curve), body).curve;
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

TEST_CASE("joints are the same without the curve") {
    ExtractOptions options;
    options.with_curve = false;
    for (const char* name : {"walking-woman", "hands-clasped-woman", "figure"}) { // the second one touches itself
        INFO(name);
        const Mesh mesh = load_fixture_body(name).mesh;
        const Extraction<double> found = extract_skeleton(mesh), alone = extract_skeleton(mesh, options);
        for (std::size_t j = 0; j < found.skeleton.joints.size(); ++j)
            CHECK(alone.skeleton.joints[j].position == found.skeleton.joints[j].position);
        CHECK(alone.skeleton.quality.sides_confidence == found.skeleton.quality.sides_confidence);
        CHECK(alone.curve.nodes.rows() == 0);
        CHECK(found.curve.nodes.rows() > 100);
        CHECK(found.curve.radii.size() == static_cast<std::size_t>(found.curve.nodes.rows()));
        std::size_t in_regions = 0;
        for (const std::vector<int>& region : found.curve.regions) in_regions += region.size();
        CHECK(in_regions == static_cast<std::size_t>(mesh.vertices.rows()));
    }
}

TEST_CASE("a draft of a body that touches itself is made whole first: regions say where") {
    const Body<double> body = prepare(load_fixture_body("hands-clasped-woman").mesh);
    ExtractOptions options = fitting::for_first_try({});
    const auto draft = find_curve(body, options.curve);
    REQUIRE(draft.is_draft);
    const auto from_draft = fit(body, draft, builtin_template("human21"), options, 1);
    options.curve.is_draft = false;
    const auto from_whole = fit(body, finished(draft, body), builtin_template("human21"), options, 1);
    REQUIRE(from_draft);
    REQUIRE(from_whole);
    for (std::size_t j = 0; j < from_whole->skeleton.joints.size(); ++j)
        CHECK(from_draft->skeleton.joints[j].position == from_whole->skeleton.joints[j].position);
}
