#include <skelgen/refinement/impl/flat_end.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

#include "catch.hpp"
#include "refinement/limb_shapes.hpp"
#include "shapes.hpp"

using namespace skelgen;
using namespace skelgen::refinement;
using namespace skelgen::test;

namespace {

constexpr double length = 1, radius = 0.05;

/// How flat a limb along z ends that has this surface, which ends at `top`.
template <typename Scalar>
Scalar flatness(const Mesh& mesh, double top) {
    const Body<Scalar> body = body_of<Scalar>(mesh);
    const Limb<Scalar> limb = limb_along<Scalar>({Vec3::Zero(), Vec3(0, 0, top)}, {0}, {0.5}, radius);
    return flat_end(body.mesh, limb, end_point_near(body, Vec3(0, 0, top)), Scalar(0.2));
}

/// How much of its section the hole encloses that a limb along z ends in; `rim` is around it.
double openness(const Mesh& mesh, const std::vector<int>& rim) {
    const Body<double> body = body_of<double>(mesh);
    const Limb<double> limb = limb_along<double>({Vec3::Zero(), Vec3(0, 0, length)}, {0}, {0.5}, radius);
    EndPoint<double> end = end_point_near(body, Vec3(radius, 0, length));
    end.rim = rim;
    return open_end(body.mesh, limb, end, 0.2);
}

/// The vertices of a cylinder along z at that height, in order around it.
std::vector<int> ring_at(const Mesh& mesh, double height) {
    std::vector<int> ring;
    for (int v = 0; v < mesh.vertices.rows(); ++v) {
        const double from_axis = mesh.vertices.row(v).head<2>().norm();
        if (std::abs(mesh.vertices(v, 2) - height) < 1e-9 && from_axis > 0.99 * radius) ring.push_back(v);
    }
    const auto angle = [&](int v) { return std::atan2(mesh.vertices(v, 1), mesh.vertices(v, 0)); };
    std::sort(ring.begin(), ring.end(), [&](int a, int b) { return angle(a) < angle(b); });
    return ring;
}

} // namespace

TEST_CASE("the hole of a limb that was cut off encloses its section, however oblique it is") {
    const Mesh tube = cylinder(radius, length);
    const std::vector<int> rim = ring_at(tube, length);
    REQUIRE(rim.size() == 32);
    CHECK(openness(tube, rim) == Approx(1).epsilon(0.02));
    CHECK(openness(tube, {rim.rbegin(), rim.rend()}) == Approx(1).epsilon(0.02));
    CHECK(openness(tube, {}) == 0);
    CHECK(openness(tube, {rim[0], rim[1], rim[2]}) < 0.1);
    CHECK(openness(tube, ring_at(tube, 0)) == 0); // at its other end
    Mesh oblique = tube, along = tube;
    for (const int v : rim) {
        oblique.vertices(v, 2) += tube.vertices(v, 0);     // 45 degrees
        along.vertices(v, 2) += 2.2 * tube.vertices(v, 0); // 66 degrees, as little as a sole
    }
    CHECK(openness(oblique, rim) == Approx(1).epsilon(0.02));
    CHECK(openness(along, rim) == Approx(0.6));
}

TEMPLATE_TEST_CASE("the lid of a limb that is cut off covers its section, a round end does not", "", float, double) {
    CHECK(flatness<TestType>(cylinder(radius, length), length) == Approx(1).epsilon(0.05));
    CHECK(flatness<TestType>(capsule(radius, length), length + radius) < 0.2);
}

TEST_CASE("a limb may be cut off obliquely") {
    Mesh cut = cylinder(radius, length);
    for (Eigen::Index v = 0; v < cut.vertices.rows(); ++v)
        if (cut.vertices(v, 2) > length - 1e-9) cut.vertices(v, 2) += 0.5 * cut.vertices(v, 0); // 27 degrees
    CHECK(flatness<double>(cut, length) > 1);
}

TEST_CASE("a limb without sections near its end says nothing") {
    const Body<double> body = body_of<double>(cylinder(radius, length));
    Limb<double> limb = limb_along<double>({Vec3::Zero(), Vec3(0, 0, length)}, {0}, {0.5}, radius);
    limb.line.thickness.setZero();
    CHECK(flat_end(body.mesh, limb, end_point_near(body, Vec3(0, 0, length)), 0.2) == 0);
}

TEST_CASE("a mesh with edges as long as its limb is thick says nothing") {
    Mesh coarse; // a prism over a triangle, which reaches beyond where it is cut off
    coarse.vertices.resize(6, 3);
    coarse.vertices << radius, 0, 0, -radius, radius, 0, -radius, -radius, 0, //
        radius, 0, length, -radius, radius, length, -radius, -radius, length;
    coarse.faces.resize(8, 3);
    coarse.faces << 0, 2, 1, 3, 4, 5, 0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4, 2, 0, 3, 2, 3, 5;
    CHECK(flatness<double>(coarse, length) == 0);
    CHECK(flatness<double>(cylinder(radius, length), length) > 0.9);
}

TEMPLATE_TEST_CASE("a block's arm looks to four sides, a round one does not", "", float, double) {
    const auto measured = [](const Mesh& mesh, double top) {
        const Body<TestType> body = body_of<TestType>(mesh);
        const Limb<TestType> limb = limb_along<TestType>({Vec3::Zero(), Vec3(0, 0, top)}, {0}, {0.5}, radius);
        return four_sidedness(body.mesh, limb, end_point_near(body, Vec3(0, 0, top)), TestType(0.4));
    };
    Mesh arm = box(Vec3(0.08, 0.1, length), 3);
    const Vec3 low = arm.vertices.colwise().minCoeff().transpose();
    arm.vertices.rowwise() -= low.transpose();
    CHECK(measured(arm, length) > 0.95);
    for (Eigen::Index v = 0; v < arm.vertices.rows(); ++v) { // turned about its length
        const double x = arm.vertices(v, 0), y = arm.vertices(v, 1);
        arm.vertices(v, 0) = 0.8 * x - 0.6 * y;
        arm.vertices(v, 1) = 0.6 * x + 0.8 * y;
    }
    CHECK(measured(arm, length) > 0.95);
    CHECK(measured(capsule(radius, length), length + radius) < 0.2);
}
