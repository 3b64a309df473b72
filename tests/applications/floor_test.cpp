#include <string>
#include <vector>

#include <skelgen/applications/floor.hpp>
#include <skelgen/applications/impl/bones.hpp>

#include "catch.hpp"
#include "human.hpp"
#include "mesh_changes.hpp"
#include "shapes.hpp"

namespace {

using namespace skelgen;
using namespace skelgen::applications;
using test::human;
using Vec = Eigen::Vector3d;

Joint<double>& joint(KinematicSkeleton<double>& skeleton, const std::string& name) {
    return skeleton.joints[static_cast<std::size_t>(find_joint(skeleton, name))];
}

void lift(KinematicSkeleton<double>& skeleton, const std::string& side, double by) {
    for (const char* name : {"ankle", "foot"}) joint(skeleton, side + name).position.y() += by;
    for (auto& [name, place] : skeleton.end_points)
        if (name == side + "toe") place.y() += by;
}

Eigen::Matrix3d pitch(double degrees) {
    return Eigen::AngleAxisd(degrees * test::pi / 180, Vec::UnitX()).toRotationMatrix();
}

/// Feet as boxes, 0.3 long, whose soles lie on y = 0 under the joints of the template's rest pose.
struct Standing {
    KinematicSkeleton<double> skeleton = rest_skeleton<double>(human());
    TriangleMesh<double> mesh = test::side_by_side(foot(0.02), foot(-0.12));

    static TriangleMesh<double> foot(double x) {
        TriangleMesh<double> out = test::box({0.1, 0.08, 0.3}, 3);
        out.vertices.rowwise() += Eigen::RowVector3d(x, 0, -0.08);
        return out;
    }
    void lean(double degrees) {
        const Vec hips = joint(skeleton, "crotch").position;
        skeleton.frame.up = pitch(degrees) * Vec::UnitY();
        for (const char* name : {"waist", "chest", "neck", "head"}) {
            Vec& place = joint(skeleton, name).position;
            place = hips + pitch(degrees) * (place - hips);
        }
    }
    void turn(const Eigen::Matrix3d& by) {
        mesh.vertices *= by.transpose();
        for (Joint<double>& of : skeleton.joints) of.position = by * of.position;
        for (auto& [name, place] : skeleton.end_points) place = by * place;
        skeleton.frame.up = by * skeleton.frame.up;
    }
    [[nodiscard]] Vec up() const { return upright(mesh, skeleton, human()); }
};

TEST_CASE("upright: who leans on both soles, or a little on one, does so upright", "[applications][floor]") {
    Standing bent;
    bent.lean(40);
    CHECK(bent.up() == Vec::UnitY());
    bent.turn(pitch(90));
    CHECK(bent.up() == Vec::UnitZ());

    Standing on_one_leg;
    lift(on_one_leg.skeleton, "left_", 0.4);
    on_one_leg.lean(20);
    CHECK(on_one_leg.up() == Vec::UnitY());
    on_one_leg.lean(30);
    CHECK((on_one_leg.up() - on_one_leg.skeleton.frame.up).norm() == 0);
}

TEST_CASE("upright: without a flat sole it is along the trunk", "[applications][floor]") {
    for (const double degrees : {-20.0, 20.0, 35.0}) {
        Standing turned; // the whole body, soles and all
        turned.turn(pitch(degrees));
        CHECK((turned.up() - pitch(degrees) * Vec::UnitY()).norm() < 1e-12);
    }
    Standing tiptoe;
    for (Eigen::Index v = 0; v < tiptoe.mesh.vertices.rows(); ++v)
        if (tiptoe.mesh.vertices(v, 2) < 0.1) tiptoe.mesh.vertices(v, 1) += 0.1;
    CHECK(tiptoe.up() == Vec::UnitY()); // as the frame has it
    tiptoe.lean(10);
    CHECK((tiptoe.up() - tiptoe.skeleton.frame.up).norm() == 0);
}

TEST_CASE("floor: who stands on one leg stands, who floats does not", "[applications][floor]") {
    auto skeleton = rest_skeleton<double>(human());
    TriangleMesh<double> slab = test::box({1, 1.7, 0.4}, 1);
    const Floor<double> floor = floor_of(slab, skeleton, human());
    CHECK(floor.is_stood_on);
    CHECK(floor.up == Vec::UnitY());
    CHECK(floor.height == 0);
    lift(skeleton, "left_", 0.4);
    CHECK(floor_of(slab, skeleton, human()).is_stood_on);
    slab.vertices.col(1).array() -= 0.5; // feet far above its lowest place
    CHECK_FALSE(floor_of(slab, skeleton, human()).is_stood_on);
}

} // namespace
