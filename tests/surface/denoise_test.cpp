#include <random>

#include <skelgen/core/geometry.hpp>
#include <skelgen/surface/denoise.hpp>

#include "catch.hpp"
#include "mesh_changes.hpp"
#include "shapes.hpp"

using namespace skelgen;
using namespace skelgen::core;
using namespace skelgen::surface;
using namespace skelgen::test;

namespace {

Mesh noisy(Mesh mesh, double deviation) {
    std::mt19937 random(1);
    std::normal_distribution<double> noise(0, deviation);
    for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v)
        for (int k = 0; k < 3; ++k) mesh.vertices(v, k) += noise(random);
    return mesh;
}

/// Root mean square distance from the unit sphere.
double roughness(const Mesh& mesh) { return std::sqrt((mesh.vertices.rowwise().norm().array() - 1).square().mean()); }

} // namespace

TEST_CASE("smooth surfaces bulge coherently, noisy ones do not, in any unit") {
    CHECK(bulge_coherence(sphere(1, 4)) > 0.9);
    CHECK(bulge_coherence(torus(1, 0.3)) > 0.9);
    CHECK(bulge_coherence(box({1, 1, 1}, 4)) > 0.2); // edges and corners are where they are
    CHECK(bulge_coherence(noisy(sphere(1, 4), 0.05)) < 0.1);
    CHECK(bulge_coherence(noisy(sphere(1000, 4), 50)) == Approx(bulge_coherence(noisy(sphere(1, 4), 0.05))));
    CHECK(bulge_coherence(make_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}})) == 1);
}

TEST_CASE("a mesh without noise is left untouched") {
    for (const Mesh& mesh : {sphere(1, 3), torus(1, 0.3), cube(4), capsule(0.3, 4)}) {
        const DenoisedMesh<double> same = remove_noise(mesh);
        CHECK(is_without_noise(mesh));
        CHECK(same.passes == 0);
        CHECK(same.mesh.vertices == mesh.vertices);
    }
    CHECK_FALSE(is_without_noise(noisy(sphere(1, 4), 0.05)));
}

TEST_CASE("which way faces are turned, and in what order they come, says nothing about noise") {
    const Mesh mesh = noisy(torus(1, 0.3), 0.01);
    Mesh inside_out = mesh;
    inside_out.faces.col(0).swap(inside_out.faces.col(1));
    CHECK(bulge_coherence(inside_out) == Approx(bulge_coherence(mesh)));
    CHECK(bulge_coherence(shuffled(mesh, 1)) == Approx(bulge_coherence(mesh)));
    for (const double more : {-1e-9, 1e-9}) { // a closed surface is judged by its faces, as it is by its edges
        DenoiseOptions options;
        options.least_coherence = bulge_coherence(mesh) + more;
        options.enough_coherence = 1;
        CHECK(is_without_noise(mesh, options) == (more < 0));
        CHECK(is_without_noise(inside_out, options) == (more < 0));
        CHECK((remove_noise(mesh, options).passes == 0) == (more < 0));
    }
}

TEST_CASE("noise is smoothed away, and the shape keeps its size") {
    const double before = roughness(noisy(sphere(1, 5), 0.02));
    const auto [mesh, passes] = remove_noise(noisy(sphere(1, 5), 0.02));
    CHECK(passes > 0);
    CHECK(roughness(mesh) < before / 2);
    CHECK(bulge_coherence(mesh) > 0.3);
    CHECK(mesh.vertices.rowwise().norm().mean() == Approx(1).epsilon(0.005));
    CHECK(enclosed_volume(mesh) == Approx(4 * pi / 3).epsilon(0.02));
}

TEST_CASE("a vertex of no face stays where it is") {
    Mesh mesh = noisy(sphere(1, 4), 0.05);
    mesh.vertices.conservativeResize(mesh.vertices.rows() + 1, 3);
    mesh.vertices.bottomRows<1>() << 7, 8, 9;
    const DenoisedMesh<double> smooth = remove_noise(mesh);
    CHECK(smooth.passes > 0);
    CHECK(smooth.mesh.vertices.bottomRows<1>() == Eigen::RowVector3d(7, 8, 9));
}

TEST_CASE("single precision smooths as double precision does") {
    const Mesh mesh = noisy(sphere(1, 4), 0.05);
    const DenoisedMesh<float> rounded = remove_noise(TriangleMesh<float>{mesh.vertices.cast<float>(), mesh.faces});
    const DenoisedMesh<double> exact = remove_noise(mesh);
    CHECK(rounded.passes == exact.passes);
    CHECK((rounded.mesh.vertices.cast<double>() - exact.mesh.vertices).cwiseAbs().maxCoeff() < 1e-5);
}

TEST_CASE("options out of their range are refused with the range") {
    DenoiseOptions options;
    options.most_passes = -1;
    CHECK_THROWS_WITH(remove_noise(sphere(1, 2), options),
                      "option denoise.most_passes is -1: it must be from 0 to 1000");
}
