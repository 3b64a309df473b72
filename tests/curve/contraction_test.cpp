#include <algorithm>
#include <cmath>

#include <skelgen/curve/contraction.hpp>

#include "catch.hpp"
#include "curve/proxy_mesh.hpp"
#include "curve/throws.hpp"
#include "mesh_changes.hpp"
#include "shapes.hpp"

using namespace skelgen;
using namespace skelgen::curve;
using namespace skelgen::test;

namespace {

/// Of the vertices between `low` and `high` on the z axis.
template <typename Scalar>
Scalar farthest_from_axis(const Points<Scalar>& vertices, Scalar low, Scalar high) {
    Scalar farthest = 0;
    for (Eigen::Index v = 0; v < vertices.rows(); ++v)
        if (vertices(v, 2) >= low && vertices(v, 2) <= high)
            farthest = std::max(farthest, vertices.row(v).template head<2>().norm());
    return farthest;
}

} // namespace

TEMPLATE_TEST_CASE("a cylinder contracts to its axis", "", float, double) {
    constexpr TestType length = 4, radius = TestType(0.3);
    const Contraction<TestType> contraction = contract(proxy_mesh(mesh_in<TestType>(cylinder(radius, length))));
    CHECK(contraction.converged);
    CHECK(contraction.volume_ratio < 0.01);
    CHECK(farthest_from_axis<TestType>(contraction.vertices, radius, length - radius) < 0.02 * length);
    // Within a radius of a flat lid the medial axis is no line but a cone out to the rim.
    CHECK(farthest_from_axis<TestType>(contraction.vertices, 0, length) < 0.8 * radius);
    CHECK(contraction.vertices.col(2).minCoeff() > 0);
    CHECK(contraction.vertices.col(2).maxCoeff() < length);
    CHECK(contraction.vertices.col(2).maxCoeff() - contraction.vertices.col(2).minCoeff() > 0.7 * length);
}

TEST_CASE("a capsule contracts to its axis, however it lies and whatever its size") {
    constexpr double length = 4;
    const Motion motion{random_rotation(2), 50, Vec3(300, 200, 100)};
    ContractionOptions patient; // what is long and even takes more iterations than a body
    patient.iterations = 20;
    Contraction<double> contraction = contract(proxy_mesh(moved(capsule(0.25, length), motion)), patient);
    for (Eigen::Index v = 0; v < contraction.vertices.rows(); ++v)
        contraction.vertices.row(v) = motion.undo(contraction.vertices.row(v).transpose()).transpose();
    CHECK(contraction.converged);
    CHECK(farthest_from_axis<double>(contraction.vertices, -length, 2 * length) < 0.02 * length);
    CHECK(contraction.vertices.col(2).maxCoeff() - contraction.vertices.col(2).minCoeff() > 0.6 * length);
}

TEST_CASE("a torus contracts to a ring around its hole") {
    const Contraction<double> contraction = contract(proxy_mesh(torus(1, 0.25)));
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
    const Contraction<double> contraction = contract(proxy_mesh(torus(1, 0.25), 800), options);
    CHECK(contraction.iterations == 1);
    CHECK_FALSE(contraction.converged);
    CHECK(contraction.volume_ratio < 1);
}

TEST_CASE("a float mesh contracts as the same mesh in double does") {
    const Mesh proxy = proxy_mesh(capsule(0.2, 4));
    const Contraction<double> expected = contract(proxy);
    const Contraction<float> contraction = contract(mesh_in<float>(proxy));
    CHECK(contraction.iterations == expected.iterations);
    CHECK(contraction.converged == expected.converged);
    CHECK(contraction.volume_ratio == Approx(expected.volume_ratio).epsilon(1e-3));
    CHECK((contraction.vertices.cast<double>() - expected.vertices).cwiseAbs().maxCoeff() < 1e-4);
}

TEST_CASE("a surface that encloses nothing cannot converge") {
    Mesh flat = proxy_mesh(box({1, 1, 0.1}, 3), 400);
    flat.vertices.col(2).setZero();
    const Contraction<double> contraction = contract(flat);
    CHECK(contraction.vertices.allFinite());
    CHECK_FALSE(contraction.converged);
    CHECK(contraction.volume_ratio == 1);
}

TEST_CASE("contraction refuses options that make no sense") {
    const Mesh mesh = sphere(1, 2);
    const auto is_refused = [&](double ContractionOptions::*option, double value) {
        ContractionOptions options;
        options.*option = value;
        return throws(ErrorCode::usage, [&] { static_cast<void>(contract(mesh, options)); });
    };
    CHECK(is_refused(&ContractionOptions::laplacian_weight, 0));
    CHECK(is_refused(&ContractionOptions::laplacian_growth, std::nan("")));
    CHECK(is_refused(&ContractionOptions::attraction_weight, -1));
    CHECK(is_refused(&ContractionOptions::medial_weight, -1));
    CHECK(is_refused(&ContractionOptions::largest_medial_radius, 0));
    ContractionOptions none;
    none.iterations = 0;
    CHECK(throws(ErrorCode::usage, [&] { static_cast<void>(contract(mesh, none)); }));
}

TEST_CASE("balls are drawn to, whoever looked for them") {
    const Mesh proxy = proxy_mesh(capsule(0.25, 2), 400);
    MedialBalls<double> balls = contraction_balls(proxy);
    const Points<double> expected = contract(proxy).vertices;
    CHECK(contract(proxy, balls).vertices == expected);
    balls.centres.rowwise() += Eigen::RowVector3d(0.1, 0, 0);
    CHECK((contract(proxy, balls).vertices - expected).colwise().mean()[0] > 0.05);
}

TEST_CASE("contraction keeps every vertex within the surface's bounds", "[slow]") {
    const Mesh proxy = proxy_mesh(three_tubes());
    const Contraction<double> contraction = contract(proxy);
    REQUIRE(contraction.vertices.rows() == proxy.vertices.rows());
    CHECK((contraction.vertices.colwise().minCoeff().array() >= proxy.vertices.colwise().minCoeff().array()).all());
    CHECK((contraction.vertices.colwise().maxCoeff().array() <= proxy.vertices.colwise().maxCoeff().array()).all());
}
