#include <skelgen/core/line.hpp>

#include <cmath>
#include <vector>

#include "catch.hpp"
#include "mesh_changes.hpp"

using namespace skelgen;

TEMPLATE_TEST_CASE("a line is laid through points on it, from the first to the last", "[core]", float, double) {
    using Scalar = TestType;
    using Vec = Vector3<Scalar>;
    const Vec direction = Vec(1, 2, -2) / 3, place(5, -4, 3);
    std::vector<Vec> points;
    for (const Scalar along : {Scalar(3), Scalar(1), Scalar(0), Scalar(-2)})
        points.push_back(place + along * direction);
    const core::FittedLine<Scalar> line = core::principal_line(points);
    CHECK((line.direction + direction).norm() < 1e-5);
    CHECK(core::distance_to<Scalar>(line, place) < 1e-5);
    CHECK(line.roughness < 1e-3);
    CHECK(core::distance_to<Scalar>(line, place + Vec(2, -1, 0)) == Approx(std::sqrt(5.0)).epsilon(1e-4));
}

TEST_CASE("a line's roughness is how far the points are off it to one side", "[core]") {
    const Eigen::Matrix3d turn = test::random_rotation(3);
    std::vector<Vector3<double>> points;
    for (int i = 0; i < 8; ++i) // off by 0.25 along y, by a tenth of that along z
        points.push_back(turn * Vector3<double>(i / 2, i % 2 == 0 ? 0.25 : -0.25, i / 4 == 0 ? 0.025 : -0.025));
    const core::FittedLine<double> line = core::principal_line(points);
    CHECK(line.roughness == Approx(0.25).epsilon(0.05));
    CHECK(std::abs(line.direction.dot(turn.col(0))) == Approx(1).epsilon(0.01));
}
