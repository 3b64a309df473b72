#include <cmath>
#include <optional>

#include <skelgen/refinement/fork.hpp>
#include <skelgen/refinement/trunk_axis.hpp>

#include "catch.hpp"
#include "limb_shapes.hpp"

using namespace skelgen;
using namespace skelgen::refinement;
using namespace skelgen::test;

namespace {

constexpr double thigh = 0.87 - 0.481; // of human21 at rest

/// A trunk along z from (0, 0, 1), and from there two legs, each this far to its side, ahead (along y) and down.
template <typename Scalar>
struct Figure {
    Body<Scalar> body;
    Vec3 fork;

    explicit Figure(const Vec3& leg) {
        const Vec3 top(0, 0, 1), left = top + leg, right = top + Vec3(-leg.x(), leg.y(), leg.z());
        body = body_of<Scalar>(tubes({{top, left}, {top, right}, {top, Vec3(0, 0, 2)}}, 0.12, 0.04));
        fork =
            fork_between(body.mesh, end_point_near(body, left), end_point_near(body, right))->template cast<double>();
    }

    [[nodiscard]] std::optional<TrunkAxis<Scalar>> axis() const {
        Points<double> line(4, 3);
        line << fork.transpose(), 0, 0, 1, 0.03, 0.02, 1.3, 0, 0, 1.9;
        return find_trunk_axis(Slicer<Scalar>(body), Points<Scalar>(line.cast<Scalar>()), static_cast<Scalar>(thigh));
    }
};

} // namespace

TEMPLATE_TEST_CASE("the lower trunk's axis runs through its middle, and legs held forward turn it little", "", float,
                   double) {
    const double held_forward = 0.3; // of the leg's height, 17 degrees
    for (const double ahead : {0.0, held_forward}) {
        INFO("legs held forward by " << ahead);
        const Figure<TestType> figure(Vec3(0.3, ahead, -1));
        const auto axis = figure.axis();
        REQUIRE(axis);
        CHECK(std::hypot(axis->place.x(), axis->place.y()) < 0.02 + 0.2 * ahead);
        CHECK(axis->up.z() > std::cos(0.1 + ahead));
        CHECK(axis->place.z() > figure.fork.z() + 0.4 * thigh);
        CHECK(std::abs(axis->across.dot(axis->up)) < 1e-5);
        CHECK(axis->largest_section > 1.2 * pi * 0.12 * 0.12);
        CHECK(axis->largest_section < 2.5 * pi * 0.12 * 0.12);
        CHECK(axis->fork == figure.fork.template cast<TestType>());
    }
}

TEST_CASE("a line that passes the body by has no axis") {
    const Body<double> body = body_of<double>(tubes({{Vec3(3, 0, 0), Vec3(3, 0, 0.1)}}, 0.1, 0.05));
    Points<double> line(2, 3);
    line << 0, 0, 0, 0, 0, 1;
    CHECK_FALSE(find_trunk_axis(Slicer<double>(body), line, thigh).has_value());
}

TEST_CASE("a trunk's sides are where it is wider") {
    Figure<double> figure(Vec3(0.3, 0, -1));
    figure.body.mesh.vertices.col(0) *= 1.5;
    figure.body = body_of<double>(Mesh{figure.body.mesh.vertices, figure.body.mesh.faces});
    const auto axis = figure.axis();
    REQUIRE(axis);
    CHECK(axis->across.norm() > 1.0 / 3);
    CHECK(axis->across.norm() < 1);
    CHECK(std::abs(axis->across.normalized().x()) > std::cos(0.15));
}
