#include <algorithm>
#include <cmath>

#include <skelgen/core/error.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/surface/canonical_form.hpp>
#include <skelgen/surface/impl/canonical_form.hpp>

#include "catch.hpp"
#include "mesh_changes.hpp"
#include "shapes.hpp"

using namespace skelgen;
using namespace skelgen::core;
using namespace skelgen::surface;
using namespace skelgen::test;

namespace {

/// A closed surface without any symmetry: a stretched sphere with a dent and a bulge.
Mesh lopsided() {
    Mesh mesh = sphere(1, 3);
    for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
        const Vec3 p = mesh.vertices.row(v);
        const double bulge = 0.8 * std::exp(-2 * (p - Vec3(0.3, 0.2, 0.93)).squaredNorm()) -
                             0.3 * std::exp(-3 * (p - Vec3(-0.5, 0.7, -0.5)).squaredNorm());
        mesh.vertices.row(v) = ((1 + bulge) * p.cwiseProduct(Vec3(0.7, 1.1, 1.9))).transpose();
    }
    return mesh;
}

/// The same but for the mirror at the plane y = 0, as most bodies standing straight are.
Mesh mirror_symmetric() {
    Mesh mesh = sphere(1, 3);
    for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
        const Vec3 p = mesh.vertices.row(v);
        const double bulge = 0.8 * std::exp(-2 * (p - Vec3(0.3, 0, 0.95)).squaredNorm());
        mesh.vertices.row(v) = ((1 + bulge) * p.cwiseProduct(Vec3(0.7, 1.1, 1.9))).transpose();
    }
    return mesh;
}

std::vector<Motion> motions() {
    std::vector<Motion> list;
    for (unsigned seed = 1; seed <= 4; ++seed) list.push_back({random_rotation(seed), 1, Vec3::Zero()});
    list.push_back({random_rotation(5), 1000, Vec3::Zero()});
    list.push_back({random_rotation(6), 0.001, Vec3(0.4, -0.1, 0.2)});
    list.push_back({Eigen::Matrix3d::Identity(), 1, Vec3(300, -200, 100)});
    list.push_back({random_rotation(7), 1e-30, Vec3::Zero()});
    list.push_back({random_rotation(8), 1e30, Vec3::Zero()});
    return list;
}

ErrorCode error_of(const Mesh& mesh) {
    try {
        static_cast<void>(canonical_form(mesh));
    } catch (const Error& error) {
        return error.code();
    }
    return ErrorCode::internal;
}

} // namespace

TEST_CASE("the canonical form has unit area, its centroid at the origin and its principal axes along x, y, z") {
    const CanonicalMesh<double> canonical = canonical_form(moved(lopsided(), {random_rotation(3), 17, Vec3(5, 6, 7)}));
    CHECK(surface_area(canonical.mesh) == Approx(1).epsilon(1e-6));
    const surface::detail::SurfaceMoments moments = surface::detail::surface_moments(canonical.mesh);
    CHECK(moments.centroid.norm() == Approx(0).margin(1e-6));
    const Vec3 variances = moments.covariance.diagonal();
    CHECK(variances[0] > variances[1]);
    CHECK(variances[1] > variances[2]);
    CHECK((moments.covariance - Eigen::Matrix3d(variances.asDiagonal())).norm() < 1e-6);
}

TEST_CASE("the similarity is proper and takes every input vertex to its canonical place and back") {
    const Mesh mesh = moved(lopsided(), {random_rotation(4), 0.02, Vec3(-1, 2, 3)});
    const CanonicalMesh<double> canonical = canonical_form(mesh);
    const Eigen::Matrix3d& rotation = canonical.similarity.rotation;
    CHECK((rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).norm() < 1e-12);
    CHECK(rotation.determinant() == Approx(1));
    REQUIRE(canonical.input_vertex.size() == static_cast<std::size_t>(mesh.vertices.rows()));
    double there = 0, back = 0;
    for (std::size_t i = 0; i < canonical.input_vertex.size(); ++i) {
        const Vec3 input = mesh.vertices.row(canonical.input_vertex[i]);
        const Vec3 place = canonical.mesh.vertices.row(static_cast<Eigen::Index>(i));
        there = std::max(there, (canonical.similarity.to_canonical(input) - place).norm());
        back = std::max(back, (canonical.similarity.to_input(place) - input).norm());
    }
    CHECK(there < 2e-6);
    CHECK(back < 2e-6 * canonical.similarity.scale);
}

TEST_CASE("faces keep their corners and their sense") {
    const Mesh mesh = lopsided();
    const CanonicalMesh<double> canonical = canonical_form(mesh);
    CHECK(canonical.mesh.faces.rows() == mesh.faces.rows());
    CHECK(is_closed(canonical.mesh.faces));
    CHECK(enclosed_volume(canonical.mesh) ==
          Approx(enclosed_volume(mesh) / std::pow(surface_area(mesh), 1.5)).epsilon(1e-5));
}

TEST_CASE("a body moved, turned, scaled and shuffled has the same canonical form") {
    const Mesh mesh = lopsided();
    const CanonicalMesh<double> expected = canonical_form(mesh);
    unsigned seed = 1;
    for (const Motion& motion : motions()) {
        const CanonicalMesh<double> canonical = canonical_form(shuffled(moved(mesh, motion), seed++));
        INFO("scale " << motion.scale << ", translation " << motion.translation.transpose());
        CHECK((canonical.mesh.vertices - expected.mesh.vertices).cwiseAbs().maxCoeff() < 1e-9);
        const bool same_faces = canonical.mesh.faces == expected.mesh.faces; // not printed: a thousand lines
        CHECK(same_faces);
    }
}

TEST_CASE("a mirror-symmetric body has the same canonical form however it is turned") {
    // Its left and its right are equal up to rounding: only the order of the faces' corners can tell which is which.
    const Mesh mesh = mirror_symmetric();
    const CanonicalMesh<double> expected = canonical_form(mesh);
    for (unsigned seed = 1; seed <= 6; ++seed) {
        const CanonicalMesh<double> canonical =
            canonical_form(shuffled(moved(mesh, {random_rotation(seed), 1, Vec3::Zero()}), seed));
        INFO("rotation " << seed);
        CHECK((canonical.mesh.vertices - expected.mesh.vertices).cwiseAbs().maxCoeff() < 1e-9);
        const bool same_faces = canonical.mesh.faces == expected.mesh.faces; // not printed: a thousand lines
        CHECK(same_faces);
    }
}

TEST_CASE("single and double precision agree") {
    const Mesh mesh = moved(lopsided(), {random_rotation(9), 3, Vec3(1, 1, 1)});
    const TriangleMesh<float> rounded{mesh.vertices.cast<float>(), mesh.faces};
    const CanonicalMesh<float> canonical = canonical_form(rounded);
    const CanonicalMesh<double> expected = canonical_form(mesh);
    CHECK((canonical.similarity.rotation.cast<double>() - expected.similarity.rotation).norm() < 1e-5);
    CHECK((canonical.mesh.vertices.cast<double>() - expected.mesh.vertices).cwiseAbs().maxCoeff() < 1e-5);
    CHECK(canonical.input_vertex == expected.input_vertex);
    CHECK(canonical.similarity.scale == Approx(expected.similarity.scale).epsilon(1e-6));
}

TEST_CASE("a surface without extent or area is bad input") {
    Mesh point = cube();
    point.vertices.setConstant(3);
    CHECK(error_of(point) == ErrorCode::bad_input);
    Mesh line = cube();
    line.vertices.rightCols(2).setZero();
    CHECK(error_of(line) == ErrorCode::bad_input);
    Mesh tiny = cube();
    tiny.vertices *= 1e-200;
    CHECK_NOTHROW(canonical_form(tiny));
}
