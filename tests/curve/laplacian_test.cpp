#include <cmath>
#include <random>

#include <Eigen/Eigenvalues>

#include <skelgen/core/geometry.hpp>
#include <skelgen/curve/laplacian.hpp>

#include "catch.hpp"
#include "mesh_changes.hpp"
#include "shapes.hpp"

using namespace skelgen;
using namespace skelgen::core;
using namespace skelgen::curve;
using namespace skelgen::test;

namespace {

constexpr int size = 12;

/// A flat patch of nearly equilateral triangles, vertices moved a little; size x size, all angles below 90 degrees.
Mesh flat_patch() {
    std::mt19937_64 random(7);
    const auto jitter = [&] { return 0.08 * (2 * std::ldexp(static_cast<double>(random() >> 11), -53) - 1); };
    std::vector<Vec3> vertices;
    std::vector<std::array<int, 3>> faces;
    for (int j = 0; j < size; ++j)
        for (int i = 0; i < size; ++i) {
            const double x = i + 0.5 * j + jitter(), y = std::sqrt(0.75) * j + jitter();
            vertices.emplace_back(x, y, 2);
            if (i + 1 == size || j + 1 == size) continue;
            const int a = j * size + i;
            faces.push_back({a, a + 1, a + size});
            faces.push_back({a + 1, a + size + 1, a + size});
        }
    return make_mesh(vertices, faces);
}

bool is_inner(int v) { return v % size > 0 && v % size < size - 1 && v / size > 0 && v / size < size - 1; }

void check_is_laplacian(const Eigen::SparseMatrix<double>& laplacian) {
    const Eigen::MatrixXd dense = laplacian;
    CHECK(dense.allFinite());
    CHECK((dense - dense.transpose()).cwiseAbs().maxCoeff() == 0);
    CHECK(dense.rowwise().sum().cwiseAbs().maxCoeff() < 1e-9 * dense.cwiseAbs().maxCoeff());
    CHECK((dense - Eigen::MatrixXd(dense.diagonal().asDiagonal())).minCoeff() >= 0);
}

} // namespace

TEST_CASE("the Laplacian is symmetric, its rows sum to zero and its weights are positive") {
    for (const Mesh& mesh : {flat_patch(), sphere(1, 3), torus(1, 0.3, 20, 10), capsule(0.2, 4, 20, 3)})
        check_is_laplacian(cotangent_laplacian(mesh.vertices, mesh.faces));
}

TEST_CASE("the Laplacian is negative semi-definite, only constants are in its kernel") {
    const Mesh mesh = torus(1, 0.3, 20, 10);
    const Eigen::MatrixXd dense = cotangent_laplacian(mesh.vertices, mesh.faces);
    const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(dense).eigenvalues();
    CHECK(values[values.size() - 1] == Approx(0).margin(1e-9));
    CHECK(values[values.size() - 2] < -1e-3);
}

TEST_CASE("linear functions are harmonic in the plane") {
    const Mesh mesh = flat_patch();
    const auto laplacian = cotangent_laplacian(mesh.vertices, mesh.faces);
    const Eigen::VectorXd linear = mesh.vertices * Vec3(0.3, -1.7, 0.9);
    const Eigen::VectorXd image = laplacian * linear;
    for (int v = 0; v < size * size; ++v)
        if (is_inner(v)) {
            INFO("vertex " << v);
            REQUIRE(image[v] == Approx(0).margin(1e-12));
        }
}

TEST_CASE("the energy of a linear function is twice its squared slope times the area") {
    const Mesh mesh = flat_patch();
    const auto laplacian = cotangent_laplacian(mesh.vertices, mesh.faces);
    const Eigen::VectorXd linear = mesh.vertices * Vec3(3, 4, 0);
    CHECK(-linear.dot(laplacian * linear) == Approx(2 * 25 * surface_area(mesh)).epsilon(1e-9));
}

TEST_CASE("between equilateral triangles the weight is two cotangents of 60 degrees") {
    const Mesh mesh = make_mesh({{0, 0, 0}, {1, 0, 0}, {0.5, std::sqrt(0.75), 0}, {0.5, -std::sqrt(0.75), 0}},
                                {{0, 1, 2}, {1, 0, 3}});
    const auto laplacian = cotangent_laplacian(mesh.vertices, mesh.faces);
    CHECK(laplacian.coeff(0, 1) == Approx(2 / std::sqrt(3)));
    CHECK(laplacian.coeff(0, 2) == Approx(1 / std::sqrt(3)));
    CHECK(laplacian.coeff(2, 3) == 0);
}

TEST_CASE("one embedding after the other has the Laplacian that it has alone") {
    const Mesh first = torus(1, 0.3, 20, 10), second = torus(2, 0.1, 20, 10);
    REQUIRE(first.faces == second.faces);
    CotangentLaplacian laplacian(first.vertices.rows(), first.faces);
    for (const Mesh& mesh : {first, second, first}) {
        const Eigen::MatrixXd expected = cotangent_laplacian(mesh.vertices, mesh.faces);
        CHECK(Eigen::MatrixXd(laplacian.of(mesh.vertices)) == expected);
    }
}

TEST_CASE("the Laplacian knows no size") {
    const Mesh mesh = torus(1, 0.3, 20, 10);
    const Eigen::MatrixXd expected = cotangent_laplacian(mesh.vertices, mesh.faces);
    for (const double scale : {1e-8, 1e8}) {
        const Eigen::MatrixXd scaled = cotangent_laplacian(Points<double>(scale * mesh.vertices), mesh.faces);
        CHECK((scaled - expected).cwiseAbs().maxCoeff() < 1e-9);
    }
}

TEST_CASE("triangles that have degenerated to segments or points leave weights bounded and the sparsity as it was") {
    const Mesh mesh = sphere(1, 2);
    const auto sound = cotangent_laplacian(mesh.vertices, mesh.faces);
    Points<double> line = mesh.vertices, point = mesh.vertices;
    line.rightCols<2>().setZero();
    point.setConstant(0.25);
    for (const Points<double>& vertices : {line, point}) {
        const auto laplacian = cotangent_laplacian(vertices, mesh.faces, 1e4);
        check_is_laplacian(laplacian);
        CHECK(laplacian.nonZeros() == sound.nonZeros());
        const Eigen::MatrixXd dense = laplacian;
        CHECK((dense - Eigen::MatrixXd(dense.diagonal().asDiagonal())).maxCoeff() <= 1e4);
    }
}

TEST_CASE("the Laplacian of a float mesh is that of the same mesh in double") {
    const Mesh mesh = torus(1, 0.3, 20, 10);
    const Points<float> rounded = mesh.vertices.cast<float>();
    const Eigen::MatrixXd expected = cotangent_laplacian(Points<double>(rounded.cast<double>()), mesh.faces);
    const Eigen::MatrixXd laplacian = cotangent_laplacian(rounded, mesh.faces);
    CHECK(laplacian == expected);
}
