#include <cmath>
#include <vector>

#include <Eigen/Geometry>

#include <skelgen/applications/impl/bones.hpp>
#include <skelgen/applications/impl/limb_volume.hpp>
#include <skelgen/core/geometry.hpp>

#include "catch.hpp"
#include "human.hpp"
#include "mesh_changes.hpp"
#include "sleeve.hpp"

namespace {

using namespace skelgen;
using namespace skelgen::applications;
using test::human;

/// The prism around an arm without its ends.
TriangleMesh<double> open_prism() {
    TriangleMesh<double> out = test::prism(rest_skeleton<double>(human()), 0);
    const int ends = static_cast<int>(out.vertices.rows()) - 2;
    std::vector<int> kept;
    for (int f = 0; f < out.faces.rows(); ++f)
        if (out.faces.row(f).maxCoeff() < ends) kept.push_back(f);
    const Triangles faces = out.faces(kept, Eigen::all);
    out.faces = faces;
    return out;
}

Points<double> turned(const Points<double>& vertices) {
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(1, Eigen::Vector3d(1, 2, 3).normalized()));
    Points<double> out = vertices;
    for (Eigen::Index v = 0; v < out.rows(); ++v)
        out.row(v) = (turn * vertices.row(v).transpose() + Eigen::Vector3d(3, -2, 1)).transpose();
    return out;
}

TEST_CASE("limb volume: rims are closed by fans, wherever the part lies", "[applications]") {
    const TriangleMesh<double> closed = test::prism(rest_skeleton<double>(human()), 0), open = open_prism();
    const double volume = core::enclosed_volume(closed);
    CHECK(volume > 0);
    CHECK(closed_volume(closed.vertices, closed.faces) == Approx(volume));
    CHECK(closed_volume(open.vertices, open.faces) == Approx(volume));
    CHECK(closed_volume(turned(open.vertices), open.faces) == Approx(volume));
    Triangles inwards = open.faces;
    inwards.col(0).swap(inwards.col(1));
    CHECK(closed_volume(open.vertices, inwards) == Approx(-volume));
    CHECK(closed_volume(open.vertices, Triangles(0, 3)) == 0);
}

TEST_CASE("limb volume: faces that lie twice and sheets that meet in an edge have no volume that moves with the part",
          "[applications]") {
    const TriangleMesh<double> open = open_prism();
    Triangles faces(open.faces.rows() + 3, 3);
    faces << open.faces, open.faces.row(20), open.faces.row(20), open.faces.row(33).reverse();
    CHECK(closed_volume(turned(open.vertices), faces) == Approx(closed_volume(open.vertices, faces)));
}

TEST_CASE("limb volume: the piece around the bone, of those that follow it", "[applications]") {
    const auto rest = rest_skeleton<double>(human());
    const Eigen::Vector3d from = rest.joints[static_cast<std::size_t>(find_joint(rest, "left_elbow"))].position;
    const Eigen::Vector3d to = rest.joints[static_cast<std::size_t>(find_joint(rest, "left_wrist"))].position;
    const TriangleMesh<double> arm = open_prism();
    TriangleMesh<double> shield = test::prism(rest, 0);
    shield.vertices.col(1).array() += 3 * test::sleeve_radius;
    const TriangleMesh<double> both = test::side_by_side(shield, arm);
    CHECK(around_bone(both.vertices, both.faces, from, to) == both.faces.bottomRows(arm.faces.rows()));
    CHECK(around_bone(both.vertices, Triangles(0, 3), from, to).rows() == 0);

    std::vector<int> strongest(static_cast<std::size_t>(both.vertices.rows()), 2);
    CHECK(faces_following(both.faces, strongest, 2) == both.faces);
    CHECK(faces_following(both.faces, strongest, 1).rows() == 0);
    strongest[static_cast<std::size_t>(both.faces(7, 1))] = 1;
    const Triangles fewer = faces_following(both.faces, strongest, 2);
    CHECK(fewer.rows() < both.faces.rows());
    CHECK((fewer.array() != both.faces(7, 1)).all());
}

} // namespace
