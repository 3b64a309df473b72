// The curve that comes out of an extraction: the one that its skeleton was found in, or none.

#include <vector>

#include <skelgen/curve/find_curve.hpp>
#include <skelgen/extract.hpp>
#include <skelgen/search/hypothesis.hpp>
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

TEST_CASE("a skeleton that was found in a draft comes with that curve, made whole") {
    ExtractOptions options;
    options.budget = 1;
    for (const char* name : {"standing-man", "walking-woman"}) {
        INFO(name);
        const FixtureBody known = load_fixture_body(name);
        const Extraction<double> found = extract(known.mesh, options);
        REQUIRE_FALSE(found.trail.empty());
        const Body<double> body = prepare(known.mesh);
        const auto draft = find_curve(body, search::curve_options(search::Effort::draft, {}));
        CHECK(is_same(found.curve, surface::to_input(body, finished(draft, body).curve)));
        CHECK_FALSE(is_same(found.curve, surface::to_input(body, find_curve(body).curve)));
    }
}

TEST_CASE("joints are the same without the curve") {
    ExtractOptions options;
    options.with_curve = false;
    for (const char* name : {"walking-woman", "hands-clasped-woman", "figure"}) { // the second one touches itself
        INFO(name);
        const TriangleMesh<double> mesh = load_fixture_body(name).mesh;
        const Extraction<double> found = extract(mesh), alone = extract(mesh, options);
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
