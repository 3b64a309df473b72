#include <skelgen/applications/curve_skin.hpp>

#include <skelgen/core/error.hpp>

#include "catch.hpp"

namespace {

using namespace skelgen;
using namespace skelgen::applications;

/// Three nodes, of which the last has no region, and four vertices that follow joint 0, 0, 2, and 0 and 2 alike.
template <typename Scalar>
struct Curve {
    CurveSkeleton<Scalar> curve;
    Skin<Scalar> skin;

    Curve() {
        curve.nodes.resize(3, 3);
        curve.nodes << 0, 0, 0, 1, 0, 0, 2, 0, 0;
        curve.edges = {{0, 1}, {1, 2}};
        curve.regions = {{0, 1}, {2, 3}, {}};
        Eigen::MatrixX<Scalar> weights(4, 3);
        weights << 1, 0, 0, 1, 0, 0, 0, 0, 1, Scalar(0.5), 0, Scalar(0.5);
        skin = strongest_influences(weights);
    }
};

TEMPLATE_TEST_CASE("a curve's node follows the joints that its region follows on average", "[applications][curve_skin]",
                   float, double) {
    const Curve<TestType> given;
    const Skin<TestType> skin = curve_skin(given.curve, given.skin, 3);
    REQUIRE(skin.weights.rows() == 3);
    CHECK(skin.joints(0, 0) == 0);
    CHECK(skin.weights(0, 0) == 1);
    for (const int node : {1, 2}) { // the end as its neighbour
        CHECK(skin.joints(node, 0) == 2);
        CHECK(skin.weights(node, 0) == Approx(0.75));
        CHECK(skin.joints(node, 1) == 0);
        CHECK(skin.weights(node, 1) == Approx(0.25));
    }
}

TEST_CASE("a curve of another mesh, or without regions, has no skin", "[applications][curve_skin]") {
    Curve<double> given;
    CHECK_THROWS_AS(curve_skin(given.curve, given.skin, 2), Error); // the skin knows three joints
    given.curve.regions[0] = {4};
    CHECK_THROWS_AS(curve_skin(given.curve, given.skin, 3), Error);
    given.curve.regions = {{}, {}, {}};
    CHECK_THROWS_AS(curve_skin(given.curve, given.skin, 3), Error);
    given.curve.regions.clear();
    CHECK_THROWS_AS(curve_skin(given.curve, given.skin, 3), Error);
}

} // namespace
