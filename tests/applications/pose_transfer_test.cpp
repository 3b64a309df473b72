#include <string>

#include <skelgen/applications/bone_orientations.hpp>
#include <skelgen/applications/impl/bones.hpp>
#include <skelgen/applications/pose_transfer.hpp>
#include <skelgen/applications/posing.hpp>

#include "catch.hpp"
#include "human.hpp"
#include "mesh_changes.hpp"
#include "sample_body.hpp"
#include "shapes.hpp"

namespace {

using namespace skelgen;
using namespace skelgen::applications;
using test::human;

/// human21 at rest, turned as a whole and with its left upper arm lowered by 60 degrees.
KinematicSkeleton<double> model(const Eigen::Quaterniond& whole) {
    const auto rest = rest_skeleton<double>(human());
    const Orientations<double> from(rest.joints.size(), Eigen::Quaterniond::Identity());
    Orientations<double> to(rest.joints.size(), whole);
    const Eigen::Quaterniond lowered(Eigen::AngleAxisd(-test::pi / 3, Eigen::Vector3d::UnitZ()));
    for (const char* name : {"left_shoulder", "left_elbow", "left_wrist", "left_hand"})
        to[static_cast<std::size_t>(find_joint(rest, name))] = whole * lowered;
    return moved(rest, human(), motions<double>(rest, from, to, {3, 4, 5}));
}

double bone(const KinematicSkeleton<double>& skeleton, std::size_t j) {
    const int parent = skeleton.joints[j].parent;
    return (skeleton.joints[j].position - skeleton.joints[static_cast<std::size_t>(parent)].position).norm();
}

TEST_CASE("pose: bones point where the model's do, and keep their lengths", "[applications][pose]") {
    const auto& [mesh, found, skeleton, body] = test::sample_body();
    const auto wanted = model(Eigen::Quaterniond(test::random_rotation(2)));
    const PosedBody<double> posed = pose_like(mesh, body, skeleton, wanted, human());
    CHECK(posed.mesh.faces == mesh.faces);
    Eigen::Vector3d pull = Eigen::Vector3d::Zero(); // none at the geometric median of the ways to the model's joints
    for (std::size_t j = 0; j < skeleton.joints.size(); ++j)
        pull += (wanted.joints[j].position - posed.skeleton.joints[j].position).normalized();
    CHECK(pull.norm() < 0.01);
    for (std::size_t j = 1; j < skeleton.joints.size(); ++j)
        if (human().joints[j].role != JointRole::shoulder) CHECK(bone(posed.skeleton, j) == Approx(bone(skeleton, j)));
    const auto breadth = [](const KinematicSkeleton<double>& of) {
        return bone(of, static_cast<std::size_t>(find_joint(of, "left_shoulder"))) +
               bone(of, static_cast<std::size_t>(find_joint(of, "right_shoulder")));
    };
    CHECK(breadth(posed.skeleton) == Approx(breadth(skeleton)));
    const auto direction = [](const KinematicSkeleton<double>& of, const char* a, const char* b) {
        const auto place = [&](const char* name) {
            return of.joints[static_cast<std::size_t>(find_joint(of, name))].position;
        };
        return (place(b) - place(a)).normalized().eval();
    };
    for (const auto& [a, b] : {std::pair{"left_shoulder", "left_elbow"},
                               {"left_elbow", "left_wrist"},
                               {"right_shoulder", "right_elbow"},
                               {"left_hip", "left_knee"},
                               {"right_knee", "right_ankle"},
                               {"chest", "left_shoulder"},
                               {"waist", "chest"}})
        CHECK((direction(posed.skeleton, a, b) - direction(wanted, a, b)).norm() < 1e-9);
    const auto along_pelvis = [](const KinematicSkeleton<double>& of) {
        const auto place = [&](const char* name) {
            return of.joints[static_cast<std::size_t>(find_joint(of, name))].position;
        };
        return (place("waist") - (place("left_hip") + place("right_hip")) / 2).normalized().eval();
    };
    CHECK((along_pelvis(posed.skeleton) - along_pelvis(wanted)).norm() < 1e-9);

    // The skin goes with the bones: the posed body, held as it was, is what it was.
    const PosedBody<double> back =
        pose_like(posed.mesh, surface::prepare(posed.mesh), posed.skeleton, skeleton, human());
    CHECK((back.mesh.vertices - mesh.vertices).rowwise().norm().mean() < 0.01);
    CHECK((back.skeleton.joints[8].position - skeleton.joints[8].position).norm() < 1e-3);
}

TEST_CASE("pose: a joint that was found off does not move the body", "[applications][pose]") {
    const auto& [mesh, found, skeleton, body] = test::sample_body();
    auto model = skeleton;
    auto& hand = model.joints[static_cast<std::size_t>(find_joint(model, "left_hand"))];
    const auto& wrist = model.joints[static_cast<std::size_t>(hand.parent)];
    hand.position += 5 * (hand.position - wrist.position); // no bone turns
    const PosedBody<double> posed = pose_like(mesh, body, skeleton, model, human());
    const int neck = find_joint(skeleton, "neck");
    const auto at = [&](const KinematicSkeleton<double>& of) {
        return of.joints[static_cast<std::size_t>(neck)].position;
    };
    CHECK((at(posed.skeleton) - at(skeleton)).norm() < 1e-3);
}

TEST_CASE("pose: who stands stays on the floor", "[applications][pose]") {
    const auto standing = rest_skeleton<double>(human());
    TriangleMesh<double> slab = test::box({1, 1.7, 0.4}, 1);
    const Floor<double> floor = floor_of(slab, standing, human());
    slab.vertices.col(1).array() -= 0.5;
    const PosedBody<double> put = put_on(PosedBody<double>{slab, standing}, floor);
    CHECK(put.mesh.vertices.col(1).minCoeff() == Approx(0).margin(1e-12));
    CHECK(put.skeleton.joints[0].position.y() == Approx(standing.joints[0].position.y() + 0.5));
    CHECK(put.skeleton.end_points[0].second.y() == Approx(standing.end_points[0].second.y() + 0.5));
}

} // namespace
