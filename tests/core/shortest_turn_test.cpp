#include <skelgen/core/shortest_turn.hpp>

#include "catch.hpp"
#include "shapes.hpp"

using namespace skelgen;
using core::shortest_turn;
using test::Vec3;

TEST_CASE("the shortest turn lays one direction on another, by the angle between them, about an axis across both") {
    const Vec3 from(1, 2, 3), to(-2, 0.5, 1);
    const Eigen::AngleAxisd turn(shortest_turn<double>(from, to));
    CHECK((turn * from.normalized() - to.normalized()).norm() < 1e-14);
    CHECK(turn.angle() == Approx(std::acos(from.dot(to) / (from.norm() * to.norm()))));
    CHECK(std::abs(turn.axis().dot(from)) < 1e-14);
    CHECK(std::abs(turn.axis().dot(to)) < 1e-14);
}

TEST_CASE("a direction is turned to itself by nothing, and to its opposite by half a turn across it") {
    const Vec3 from(0.3, -2, 0.1);
    CHECK(shortest_turn<double>(from, 2 * from).angularDistance(Eigen::Quaterniond::Identity()) < 1e-7);
    for (const double off : {0.0, 1e-13, 1e-7}) {
        const Eigen::Quaterniond turn = shortest_turn<double>(from, -3 * from + Vec3(0, 0, off));
        CHECK(turn.norm() == Approx(1));
        CHECK((turn * from + from).norm() < 1e-6);
    }
}

TEST_CASE("it is what Eigen finds") {
    const Vec3 from(0.2, -1, 0.7), to(0.9, 0.1, -0.4);
    CHECK(shortest_turn<double>(from, to).coeffs() == Eigen::Quaterniond::FromTwoVectors(from, to).coeffs());
}
