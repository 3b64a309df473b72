#include <cmath>
#include <string>

#include <skelgen/applications/bone_orientations.hpp>
#include <skelgen/applications/impl/bones.hpp>
#include <skelgen/applications/impl/rest_posture.hpp>
#include <skelgen/applications/posing.hpp>
#include <skelgen/core/builtin_templates.hpp>
#include <skelgen/core/error.hpp>
#include <skelgen/core/shoulder_height.hpp>

#include "catch.hpp"
#include "human.hpp"
#include "mesh_changes.hpp"
#include "shapes.hpp"

namespace {

using namespace skelgen;
using namespace skelgen::applications;
using test::human;
using Rotation = Eigen::Quaterniond;

std::size_t index_of(const std::string& name) {
    return static_cast<std::size_t>(find_joint(rest_skeleton<double>(human()), name));
}

Rotation about(double degrees, const Eigen::Vector3d& axis) {
    return Rotation(Eigen::AngleAxisd(degrees * test::pi / 180, axis));
}

/// The rest pose with each joint turned, relative to its parent, by `turn` about its own axes, and all by `whole`.
Orientations<double> pose_of(const std::vector<std::pair<std::string, Rotation>>& turns, const Rotation& whole) {
    const Orientations<double> axes = rest_axes<double>(human());
    Orientations<double> pose;
    for (std::size_t j = 0; j < human().joints.size(); ++j) {
        Rotation own = Rotation::Identity();
        for (const auto& [name, turn] : turns)
            if (name == human().joints[j].name) own = axes[j] * turn * axes[j].conjugate();
        const int parent = human().joints[j].parent;
        pose.push_back((parent < 0 ? whole : pose[static_cast<std::size_t>(parent)]) * own);
    }
    return pose;
}

KinematicSkeleton<double> posed(const Orientations<double>& pose) {
    const auto rest = rest_skeleton<double>(human());
    const Orientations<double> from(rest.joints.size(), Rotation::Identity());
    return moved(rest, human(), motions<double>(rest, from, pose, {1, 2, 3}));
}

TEST_CASE("bones: each joint's children and the ends of limbs", "[applications][bones]") {
    const auto rest = rest_skeleton<double>(human());
    const auto bones = bones_of(rest, human());
    CHECK(bones.size() == 20 + 5);
    CHECK(next_joint(human(), 0) == 1); // from the crotch up, not into a leg
    CHECK(bone_end(rest, human(), 4) == Eigen::Vector3d(0, 1.777, 0.02));
    auto without_end = rest;
    without_end.end_points.clear();
    CHECK(bones_of(without_end, human()).size() == 20);
    CHECK(bone_end(without_end, human(), 4) == rest.joints[4].position);
    auto other = rest;
    other.joints.pop_back();
    CHECK_THROWS_AS(bones_of(other, human()), Error);
    CHECK_THROWS_AS(bone_end(other, human(), 0), Error);
}

TEST_CASE("axes: along the bones, bending about x, mirrored from side to side", "[applications][axes]") {
    const auto rest = rest_skeleton<double>(human());
    const auto axes = rest_axes<double>(human());
    const Eigen::Vector3d mirror(-1, 1, 1);
    for (std::size_t j = 0; j < axes.size(); ++j) {
        CAPTURE(human().joints[j].name);
        const Eigen::Vector3d along = bone_end(rest, human(), static_cast<int>(j)) - rest.joints[j].position;
        CHECK((axes[j] * Eigen::Vector3d::UnitY() - along.normalized()).norm() < 1e-12);
        const int other = counterpart(human(), static_cast<int>(j));
        if (other < 0) continue;
        const Rotation& there = axes[static_cast<std::size_t>(other)];
        CHECK((axes[j] * Eigen::Vector3d::UnitX() + mirror.cwiseProduct(there * Eigen::Vector3d::UnitX())).norm() <
              1e-12);
    }
    // By a positive angle about x the forearm comes forwards, the calf goes backwards.
    for (const std::string side : {"left_", "right_"}) {
        const auto bent = posed(pose_of({{side + "elbow", about(90, Eigen::Vector3d::UnitX())},
                                         {side + "knee", about(90, Eigen::Vector3d::UnitX())}},
                                        Rotation::Identity()));
        const auto place = [&](const std::string& name) { return bent.joints[index_of(side + name)].position; };
        CHECK((place("wrist") - place("elbow")).normalized().z() == Approx(1));
        CHECK((place("ankle") - place("knee")).normalized().z() < -0.9);
    }
}

TEST_CASE("orientations: those of the rest pose are none, turned bodies' turn with them", "[applications][pose]") {
    const Rotation whole(test::random_rotation(7));
    const auto found = bone_orientations(posed(pose_of({}, whole)), human());
    for (const Rotation& rotation : found) CHECK(rotation.angularDistance(whole) < 1e-6);
}

TEST_CASE("orientations: a bent elbow or knee shows how its limb is turned about itself", "[applications][pose]") {
    const Rotation whole(test::random_rotation(3));
    const auto x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY(), z = Eigen::Vector3d::UnitZ();
    const Orientations<double> pose = pose_of({{"left_shoulder", about(-40, z) * about(50, y)},
                                               {"left_elbow", about(80, x)},
                                               {"right_shoulder", about(30, x) * about(-35, y)},
                                               {"right_elbow", about(60, x)},
                                               {"left_hip", about(-70, x) * about(20, y)},
                                               {"left_knee", about(90, x)},
                                               {"chest", about(25, y)}},
                                              whole);
    const auto found = bone_orientations(posed(pose), human());
    for (const char* name : {"crotch", "chest", "left_shoulder", "left_elbow", "right_shoulder", "right_elbow",
                             "left_hip", "left_knee", "left_ankle"}) {
        CAPTURE(name);
        // The least turn from the parent has its say, too: it is some degrees.
        CHECK(found[index_of(name)].angularDistance(pose[index_of(name)]) * 180 / test::pi < 12);
    }
    // Bones lie exactly where they are: limbs' are turned with them, and all axes lie along them.
    const auto skeleton = posed(pose);
    const auto axes = rest_axes<double>(human()), now = bone_axes(skeleton, human(), found);
    for (std::size_t j = 0; j < found.size(); ++j) {
        CAPTURE(human().joints[j].name);
        const Eigen::Vector3d along = bone_end(skeleton, human(), static_cast<int>(j)) - skeleton.joints[j].position;
        CHECK((now[j] * y - along.normalized()).norm() < 1e-9);
        if (part_of(human().joints[j].role) != BodyPart::trunk)
            CHECK((found[j] * axes[j] * y - along.normalized()).norm() < 1e-9);
    }
    CHECK_THROWS_AS(bone_axes(skeleton, human(), {}), Error);
}

TEST_CASE("orientations: a joint of pelvis or neck that is found off turns them little", "[applications][pose]") {
    const auto rest = rest_skeleton<double>(human());
    const Eigen::Vector3d off(0, 0, 0.03); // of 1.8
    const auto turned = [&](const char* found_off, const char* name) {
        auto skeleton = rest;
        skeleton.joints[index_of(found_off)].position += off;
        return bone_orientations(skeleton, human())[index_of(name)].angularDistance(Rotation::Identity()) * 180 /
               test::pi;
    };
    CHECK(turned("crotch", "crotch") < 1e-4);
    CHECK(turned("head", "neck") < 1e-4);
    CHECK(turned("waist", "crotch") < 10); // its own bone by 16
    CHECK(turned("neck", "neck") < 8);     // its own by 21
    CHECK(turned("neck", "neck") > 4);
}

TEST_CASE("orientations: a skeleton turned back by them is in the rest pose", "[applications][pose]") {
    const auto z = Eigen::Vector3d::UnitZ();
    const auto skeleton = posed(
        pose_of({{"left_shoulder", about(-80, z)}, {"right_hip", about(-30, z)}}, Rotation(test::random_rotation(5))));
    const auto now = bone_orientations(skeleton, human());
    const auto rest = rest_skeleton<double>(human());
    const auto wanted = orientations_in<double>(RestPose::t_pose, human(), now, Rotation::Identity());
    const auto back = moved(skeleton, human(), motions<double>(skeleton, now, wanted, rest.joints[0].position));
    for (const char* name : {"left_elbow", "left_wrist", "right_knee", "right_ankle", "head"})
        CHECK((back.joints[index_of(name)].position - rest.joints[index_of(name)].position).norm() < 1e-9);

    const auto lowered = orientations_in<double>(RestPose::a_pose, human(), now, Rotation::Identity());
    const auto a = moved(skeleton, human(), motions<double>(skeleton, now, lowered, {0, 0, 0}));
    for (const std::string side : {"left_", "right_"}) {
        const Eigen::Vector3d arm =
            a.joints[index_of(side + "elbow")].position - a.joints[index_of(side + "shoulder")].position;
        CHECK(arm.normalized().y() == Approx(-std::sqrt(0.5)));
    }
    CHECK_THROWS_AS(motions<double>(skeleton, {}, wanted, {0, 0, 0}), Error);
}

TEST_CASE("orientations: a raised shoulder comes down at rest, and up again", "[applications][pose]") {
    auto skeleton = posed(pose_of({{"left_shoulder", about(50, Eigen::Vector3d::UnitZ())}}, about(30, {1, 2, 3})));
    const Eigen::Vector3d up = skeleton.frame.up, lift = 0.05 * up;
    for (const char* name : {"left_shoulder", "left_elbow", "left_wrist", "left_hand"})
        skeleton.joints[index_of(name)].position += lift;
    const auto rest = rest_skeleton<double>(human());
    const auto was = bone_orientations(skeleton, human());
    const auto held = [&](RestPose pose) {
        return moved(skeleton, human(), rest_motions<double>(pose, skeleton, human(), was, Rotation::Identity()));
    };
    const auto unposed = held(RestPose::t_pose);
    const auto from_chest = [](const KinematicSkeleton<double>& of, const char* name) -> Eigen::Vector3d {
        return of.joints[index_of(name)].position - of.joints[index_of("chest")].position;
    };
    const Eigen::Vector3d mirrored = from_chest(unposed, "right_shoulder").cwiseProduct(Eigen::Vector3d(-1, 1, 1));
    CHECK((from_chest(unposed, "left_shoulder") - mirrored).norm() < 1e-9);
    // At the height at which people hold them, with lowered arms lower.
    const auto slope_of_rest = [&](RestPose pose) {
        const auto motions =
            rest_motions<double>(pose, rest, human(), bone_orientations(rest, human()), Rotation::Identity());
        return from_chest(moved(rest, human(), motions), "left_shoulder").normalized().y();
    };
    const Eigen::Vector3d way = from_chest(rest, "left_shoulder");
    const double neck = rest.joints[index_of("neck")].position.y(),
                 hips = rest.joints[index_of("left_hip")].position.y();
    const double people =
        neck + (neck - hips) * core::usual_shoulder_height(0.0, 0.0) - rest.joints[index_of("chest")].position.y();
    CHECK(slope_of_rest(RestPose::t_pose) == Approx(Eigen::Vector3d(way.x(), people, way.z()).normalized().y()));
    CHECK(slope_of_rest(RestPose::t_pose) > way.normalized().y() + 0.01);
    CHECK(slope_of_rest(RestPose::a_pose) < slope_of_rest(RestPose::t_pose) - 0.03);
    const double both = from_chest(skeleton, "left_shoulder").norm() + from_chest(skeleton, "right_shoulder").norm();
    for (const char* name : {"left_shoulder", "right_shoulder"})
        CHECK(from_chest(unposed, name).norm() == Approx(both / 2));

    for (const Rotation& rotation : bone_orientations(unposed, human()))
        CHECK(rotation.angularDistance(Rotation::Identity()) < 1e-3);
    const Orientations<double> now(was.size(), Rotation::Identity());
    const auto lines = girdle_lines(unposed, now, skeleton, was, human());
    const auto again = moved(unposed, human(), motions<double>(unposed, now, was, skeleton.joints[0].position, lines));
    for (std::size_t j = 0; j < again.joints.size(); ++j)
        CHECK((again.joints[j].position - skeleton.joints[j].position).norm() < 1e-9);

    // As it is, nothing moves but the whole.
    const auto as_is = held(RestPose::as_is);
    CHECK((from_chest(as_is, "left_shoulder") - from_chest(skeleton, "left_shoulder")).norm() < 1e-9);

    const Eigen::Vector3d line = from_chest(skeleton, "left_shoulder");
    skeleton.joints[index_of("left_shoulder")].is_present = false; // what is not there stays
    CHECK(girdle_lines(skeleton, was, rest, was, human())[index_of("left_shoulder")].isApprox(line));
    CHECK_THROWS_AS(girdle_lines(skeleton, {}, rest, was, human()), Error);
    CHECK_THROWS_AS(motions<double>(skeleton, was, was, {0, 0, 0}, {Eigen::Vector3d::Zero()}), Error);
}

TEST_CASE("orientations: joints in one place turn with their parents", "[applications][pose]") {
    auto skeleton = rest_skeleton<float>(human());
    skeleton.joints[index_of("left_wrist")].position = skeleton.joints[index_of("left_elbow")].position;
    skeleton.end_points.clear();
    for (const auto& rotation : bone_orientations(skeleton, human()))
        CHECK(rotation.angularDistance(Eigen::Quaternionf::Identity()) < 0.2F);
}

/// Someone who stands with arms lowered by so many degrees, whose bones in head and feet say little: the crown is
/// behind, the balls are deep.
KinematicSkeleton<double> standing(double lowered, double left_elbow = 0) {
    auto skeleton = rest_skeleton<double>(human());
    Orientations<double> pose(skeleton.joints.size(), Rotation::Identity());
    for (std::size_t j = 0; j < pose.size(); ++j)
        if (part_of(human().joints[j].role) == BodyPart::arm)
            pose[j] = about(human().joints[j].side == Side::left ? -lowered : lowered, Eigen::Vector3d::UnitZ());
    for (const char* name : {"left_elbow", "left_wrist", "left_hand"}) // the forearm ahead
        pose[index_of(name)] = about(-left_elbow, Eigen::Vector3d::UnitY()) * pose[index_of(name)];
    const Orientations<double> from(pose.size(), Rotation::Identity());
    skeleton = moved(skeleton, human(), motions<double>(skeleton, from, pose, skeleton.joints[0].position));
    for (auto& [name, place] : skeleton.end_points)
        if (name == "head_top") place.z() -= 0.06;
    for (const char* name : {"left_foot", "right_foot"}) skeleton.joints[index_of(name)].position.y() -= 0.03;
    return skeleton;
}

double turn_of(const std::vector<RigidMotion<double>>& motion, const std::string& joint) {
    return motion[index_of(joint)].rotation.angularDistance(Rotation::Identity()) * 180 / test::pi;
}

TEST_CASE("rest poses: faces, soles and palms stay as they are turned", "[applications][pose]") {
    const auto to_t_pose = [](const KinematicSkeleton<double>& skeleton) {
        const auto now = posture(skeleton, human(), Rotation::Identity());
        return posture_motions(RestPose::t_pose, skeleton, human(), now, Rotation::Identity());
    };
    // Their bones would turn them: the rest pose by bones alone does.
    const auto a_pose = standing(40);
    const auto by_bones =
        rest_motions(RestPose::t_pose, a_pose, human(), bone_orientations(a_pose, human()), Rotation::Identity());
    CHECK(turn_of(by_bones, "head") > 8);
    CHECK(turn_of(by_bones, "left_ankle") > 8);
    const auto motion = to_t_pose(a_pose);
    for (const char* name : {"crotch", "chest", "neck", "head", "left_ankle", "right_foot", "left_knee"})
        CHECK(turn_of(motion, name) < 1e-6);
    for (const std::string side : {"left_", "right_"}) {
        for (const char* name : {"shoulder", "elbow", "wrist", "hand"}) {
            // Raised in the plane that they are in, and not turned about themselves.
            const Rotation wanted = about(side == "left_" ? 40 : -40, Eigen::Vector3d::UnitZ());
            CHECK(motion[index_of(side + name)].rotation.angularDistance(wanted) < 0.02);
        }
        const Eigen::Vector3d arm = motion[index_of(side + "wrist")](a_pose.joints[index_of(side + "wrist")].position) -
                                    motion[index_of(side + "elbow")](a_pose.joints[index_of(side + "elbow")].position);
        CHECK(std::abs(arm.normalized().y()) < 1e-9);
        // Shoulders go up with the arms as people's do, and no farther from the chest.
        const auto& shoulder = a_pose.joints[index_of(side + "shoulder")].position;
        const Eigen::Vector3d now = motion[index_of(side + "shoulder")](shoulder) -
                                    motion[index_of("chest")](a_pose.joints[index_of("chest")].position);
        const Eigen::Vector3d was = shoulder - a_pose.joints[index_of("chest")].position;
        CHECK(now.norm() == Approx(was.norm()));
        CHECK(now.y() > was.y() + 0.01);
        CHECK(now.y() < was.y() + 0.06);
    }

    // What is within some degrees of the rest pose stays where it is.
    for (const auto& near : {to_t_pose(standing(8)),
                             posture_motions(RestPose::a_pose, a_pose, human(),
                                             posture(a_pose, human(), Rotation::Identity()), Rotation::Identity())})
        for (std::size_t j = 0; j < near.size(); ++j) {
            CHECK(near[j].rotation.angularDistance(Rotation::Identity()) < 1e-6);
            CHECK((near[j].translation - near.front().translation).norm() < 1e-9);
        }

    // So do hands, whatever their bones say: a wrist that is so bent was found off.
    KinematicSkeleton<double> off = standing(8);
    const Eigen::Vector3d wrist = off.joints[index_of("left_wrist")].position;
    Eigen::Vector3d& hand = off.joints[index_of("left_hand")].position;
    hand = wrist + about(60, Eigen::Vector3d::UnitY()) * (hand - wrist);
    for (const RigidMotion<double>& of_joint : to_t_pose(off))
        CHECK(of_joint.rotation.angularDistance(Rotation::Identity()) < 1e-6);
    // In an A-pose, they go with the forearms all the same.
    off = standing(40);
    off.joints[index_of("left_hand")].position =
        off.joints[index_of("left_wrist")].position + Eigen::Vector3d(0, 0, 0.1);
    const auto raised = to_t_pose(off);
    CHECK(raised[index_of("left_hand")].rotation.angularDistance(raised[index_of("left_elbow")].rotation) < 1e-6);

    // Joints that were found off move no trunk and no limbs whose lines are near the rest pose's, but bends do.
    off = standing(4);
    const auto place = [&](const char* name) -> Eigen::Vector3d& { return off.joints[index_of(name)].position; };
    place("waist").z() -= 0.1;
    place("left_elbow") += Eigen::Vector3d(-0.1, 0.07, 0); // the upper arm is short now, as is the calf
    place("right_knee") += Eigen::Vector3d(0, -0.25, 0.06);
    for (const char* bone : {"left_shoulder", "right_knee"}) {
        const std::size_t j = index_of(bone);
        const Eigen::Vector3d along = bone_end(off, human(), static_cast<int>(j)) - off.joints[j].position;
        const auto rest = rest_skeleton<double>(human());
        const Eigen::Vector3d wanted = bone_end(rest, human(), static_cast<int>(j)) - rest.joints[j].position;
        CHECK(along.normalized().dot(wanted.normalized()) < std::cos(15 * test::pi / 180));
    }
    for (const RigidMotion<double>& of_joint : to_t_pose(off))
        CHECK(of_joint.rotation.angularDistance(Rotation::Identity()) < 1e-6);
    for (const char* name : {"left_elbow", "right_elbow"}) place(name).y() += 0.1;
    CHECK(turn_of(to_t_pose(off), "right_shoulder") > 5);

    // An arm that is bent more than the other is no rest pose; its hand goes with the forearm all the same.
    const auto bent = standing(40, 50);
    const auto unbent = to_t_pose(bent);
    CHECK(turn_of(unbent, "head") < 1e-6);
    CHECK(unbent[index_of("left_hand")].rotation.angularDistance(unbent[index_of("left_elbow")].rotation) < 1e-6);
    const Eigen::Vector3d forearm = unbent[index_of("left_wrist")](bent.joints[index_of("left_wrist")].position) -
                                    unbent[index_of("left_elbow")](bent.joints[index_of("left_elbow")].position);
    CHECK(forearm.normalized().x() == Approx(1).margin(1e-9));
    // The elbow unbends as a hinge does, without a twist.
    const auto bone = [&](const std::string& from, const std::string& to) -> Eigen::Vector3d {
        return (bent.joints[index_of(to)].position - bent.joints[index_of(from)].position).normalized();
    };
    const double bend = std::acos(bone("left_shoulder", "left_elbow").dot(bone("left_elbow", "left_wrist")));
    CHECK(bend > 0.5);
    CHECK(unbent[index_of("left_elbow")].rotation.angularDistance(unbent[index_of("left_shoulder")].rotation) ==
          Approx(bend).epsilon(1e-6));
}

TEST_CASE("rest poses: rotations near one from axes to axes are taken for that", "[applications][pose]") {
    const Rotation quarter = about(90, Eigen::Vector3d::UnitX());
    const auto near = along_axes<double>(about(19, Eigen::Vector3d(1, 2, 3).normalized()) * quarter);
    REQUIRE(near);
    CHECK(near->angularDistance(quarter) < 1e-9);
    CHECK_FALSE(along_axes<double>(about(21, {1, 0, 0}) * quarter));
    CHECK(along_axes<double>(Rotation::Identity())->angularDistance(Rotation::Identity()) < 1e-12);
}

} // namespace
