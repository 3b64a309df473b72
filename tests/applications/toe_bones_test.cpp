#include <skelgen/applications/finger_bones.hpp>

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include <skelgen/core/builtin_templates.hpp>
#include <skelgen/hands/find_hands.hpp>
#include <skelgen/io/rig_formats.hpp>
#include <skelgen/surface/prepare.hpp>

#include "catch.hpp"
#include "hands/foot_shape.hpp"

using namespace skelgen;
using namespace skelgen::applications;
using namespace skelgen::test;

TEST_CASE("toes get two bones each below the ball of the foot, and no vertex follows two toes") {
    const Mesh mesh = foot_of(five_toes());
    const SkeletonTemplate human = builtin_template("human21");
    KinematicSkeleton<double> skeleton;
    Rig<double> rig;
    for (const TemplateJoint& joint : human.joints) {
        skeleton.joints.push_back({joint.name, joint.parent});
        rig.joints.push_back({joint.name, joint.parent, joint.role, joint.side});
        rig.motions.emplace_back();
    }
    const int foot = find_joint(human, JointRole::foot, Side::left);
    rig.mesh = mesh;
    rig.skin.joints.setZero(mesh.vertices.rows(), Skin<double>::influences);
    rig.skin.weights.setZero(mesh.vertices.rows(), Skin<double>::influences);
    rig.skin.joints.col(0).setConstant(foot);
    rig.skin.weights.col(0).setConstant(1);
    const auto feet = hands::find_feet(mesh, surface::prepare(mesh), leg_skeleton());
    rig = with_finger_bones(std::move(rig), mesh, skeleton, human, feet);

    REQUIRE(rig.joints.size() == 31);
    const auto names = io::names_of(rig.joints, io::JointNames::mixamo);
    for (int j = 21; j < 31; ++j) {
        const RigJoint<double>& bone = rig.joints[static_cast<std::size_t>(j)];
        const bool is_first = j % 2 == 1;
        CHECK(bone.name == "left_toe" + std::to_string((j - 21) / 2 + 1) + (is_first ? "_1" : "_2"));
        CHECK(bone.parent == (is_first ? foot : j - 1));
        CHECK(names[static_cast<std::size_t>(j)] == bone.name); // engines have none
        CHECK((bone.axes * Vec3::UnitY()).y() > 0.8);
    }
    int moved = 0;
    for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
        CHECK(rig.skin.weights.row(v).sum() == Approx(1));
        std::vector<int> toes;
        for (int k = 0; k < Skin<double>::influences; ++k)
            if (rig.skin.weights(v, k) > 0 && rig.skin.joints(v, k) > 20)
                toes.push_back((rig.skin.joints(v, k) - 21) / 2);
        CHECK(std::adjacent_find(toes.begin(), toes.end(), std::not_equal_to<>()) == toes.end());
        moved += toes.empty() ? 0 : 1;
        if (mesh.vertices(v, 1) < -0.6) CHECK(toes.empty());
    }
    CHECK(moved > 100);

    // A motion of the body's own joints, in which the toes are held.
    const Rig<double> bare = without_finger_bones(rig, 21);
    REQUIRE(bare.joints.size() == 21);
    CHECK((bare.skin.joints.array() == foot || bare.skin.weights.array() == 0).all());
    RigPose<double> pose;
    for (const RigJoint<double>& joint : bare.joints) pose.axes.push_back(joint.axes);
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.7, Vec3::UnitX()));
    pose.axes[static_cast<std::size_t>(foot)] = turn * pose.axes[static_cast<std::size_t>(foot)];
    const auto held = with_held_fingers(Animation<double>{"step", 0.1, {pose}}, rig);
    REQUIRE(held.frames[0].axes.size() == 31);
    for (std::size_t j = 21; j < 31; ++j)
        CHECK(held.frames[0].axes[j].angularDistance(turn * rig.joints[j].axes) < 1e-9);
}
