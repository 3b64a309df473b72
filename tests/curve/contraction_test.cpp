#include <algorithm>

#include <skelgen/curve/contraction.hpp>

#include "catch.hpp"
#include "curve/proxy_mesh.hpp"
#include "mesh_changes.hpp"
#include "shapes.hpp"

using namespace skelgen;
using namespace skelgen::test;

namespace {

/// Of the vertices between `low` and `high` on the z axis.
double farthest_from_axis(const Points<double>& vertices, double low, double high) {
    double farthest = 0;
    for (Eigen::Index v = 0; v < vertices.rows(); ++v)
        if (vertices(v, 2) >= low && vertices(v, 2) <= high)
            farthest = std::max(farthest, vertices.row(v).head<2>().norm());
    return farthest;
}

} // namespace

TEST_CASE("a cylinder contracts to its axis") {
    constexpr double length = 4, radius = 0.3;
    const Contraction contraction = contract(proxy_mesh(cylinder(radius, length)));
    CHECK(contraction.converged);
    CHECK(contraction.volume_ratio < 0.01);
    CHECK(farthest_from_axis(contraction.vertices, radius, length - radius) < 0.02 * length);
    // Within a radius of a flat lid the medial axis is no line but a cone out to the rim.
    CHECK(farthest_from_axis(contraction.vertices, 0, length) < 0.8 * radius);
    CHECK(contraction.vertices.col(2).minCoeff() > 0);
    CHECK(contraction.vertices.col(2).maxCoeff() < length);
    CHECK(contraction.vertices.col(2).maxCoeff() - contraction.vertices.col(2).minCoeff() > 0.7 * length);
}

TEST_CASE("a capsule contracts to its axis, however it lies and whatever its size") {
    constexpr double length = 4;
    const Motion motion{random_rotation(2), 50, Vec3(300, 200, 100)};
    Contraction contraction = contract(proxy_mesh(moved(capsule(0.25, length), motion)));
    for (Eigen::Index v = 0; v < contraction.vertices.rows(); ++v)
        contraction.vertices.row(v) = motion.undo(contraction.vertices.row(v).transpose()).transpose();
    CHECK(contraction.converged);
    CHECK(farthest_from_axis(contraction.vertices, -length, 2 * length) < 0.02 * length);
    CHECK(contraction.vertices.col(2).maxCoeff() - contraction.vertices.col(2).minCoeff() > 0.6 * length);
}

TEST_CASE("a torus contracts to a ring around its hole") {
    const Contraction contraction = contract(proxy_mesh(torus(1, 0.25)));
    CHECK(contraction.volume_ratio < 0.01);
    CHECK(contraction.vertices.col(2).cwiseAbs().maxCoeff() < 0.03);
    const Eigen::VectorXd from_axis = contraction.vertices.leftCols<2>().rowwise().norm();
    CHECK(from_axis.minCoeff() > 0.7); // mean curvature pulls it towards the hole
    CHECK(from_axis.maxCoeff() < 1.03);
    CHECK(from_axis.mean() > 0.85);
}

TEST_CASE("contraction stops after the iterations it is given and says so") {
    ContractionOptions options;
    options.iterations = 1;
    const Contraction contraction = contract(proxy_mesh(torus(1, 0.25), 800), options);
    CHECK(contraction.iterations == 1);
    CHECK_FALSE(contraction.converged);
    CHECK(contraction.volume_ratio < 1);
}

TEST_CASE("contraction keeps every vertex within the surface's bounds") {
    const Mesh proxy = proxy_mesh(three_tubes());
    const Contraction contraction = contract(proxy);
    REQUIRE(contraction.vertices.rows() == proxy.vertices.rows());
    CHECK((contraction.vertices.colwise().minCoeff().array() >= proxy.vertices.colwise().minCoeff().array()).all());
    CHECK((contraction.vertices.colwise().maxCoeff().array() <= proxy.vertices.colwise().maxCoeff().array()).all());
}
