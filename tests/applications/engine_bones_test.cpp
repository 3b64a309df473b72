#include <skelgen/applications/engine_bones.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>

#include <skelgen/applications/retarget.hpp>
#include <skelgen/core/error.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/io/rig_formats.hpp>

#include "catch.hpp"
#include "human.hpp"
#include "sample_body.hpp"
#include "template_rig.hpp"
#include "walking_clip.hpp"

namespace {

using namespace skelgen;
using namespace skelgen::applications;
using namespace skelgen::test;
using Vec3 = Vector3<double>;

const Rig<double>& plain_rig() {
    static const Rig<double> rig =
        make_rig(sample_body().mesh, sample_body().body, sample_body().skeleton, human(), RestPose::t_pose);
    return rig;
}

const Rig<double>& engine_rig() {
    static const Rig<double> rig = with_engine_bones(plain_rig(), {true, false});
    return rig;
}

std::size_t index_of(const Rig<double>& rig, const std::string& name) {
    for (std::size_t j = 0; j < rig.joints.size(); ++j)
        if (rig.joints[j].name == name) return j;
    FAIL("there is no joint " << name);
    return 0;
}

const RigJoint<double>& joint(const Rig<double>& rig, const std::string& name) {
    return rig.joints[index_of(rig, name)];
}

std::string parent_of(const Rig<double>& rig, const std::string& name) {
    const int parent = joint(rig, name).parent;
    return parent < 0 ? "" : rig.joints[static_cast<std::size_t>(parent)].name;
}

double weight(const Rig<double>& rig, Eigen::Index v, const std::string& name) {
    const auto j = static_cast<int>(index_of(rig, name));
    double sum = 0;
    for (int k = 0; k < 4; ++k) sum += rig.skin.joints(v, k) == j ? rig.skin.weights(v, k) : 0;
    return sum;
}

/// All joints turned by the given turns of some, which those that they carry share.
RigPose<double> held(const Rig<double>& rig, const std::vector<std::pair<std::string, Eigen::Quaterniond>>& turns) {
    RigPose<double> pose;
    pose.root = rig.joints.front().position;
    std::vector<Eigen::Quaterniond> all;
    for (const RigJoint<double>& one : rig.joints) {
        Eigen::Quaterniond turn =
            one.parent < 0 ? Eigen::Quaterniond::Identity() : all[static_cast<std::size_t>(one.parent)];
        for (const auto& [name, by] : turns)
            if (name == one.name) turn = by * turn;
        all.push_back(turn);
        pose.axes.push_back((turn * one.axes).normalized());
    }
    return pose;
}

double volume(const TriangleMesh<double>& mesh) {
    double sum = 0;
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f)
        sum += core::point(mesh.vertices, mesh.faces(f, 0))
                   .cross(core::point(mesh.vertices, mesh.faces(f, 1)))
                   .dot(core::point(mesh.vertices, mesh.faces(f, 2))) /
               6;
    return sum;
}

/// The largest stretch of an edge.
double stretch(const TriangleMesh<double>& from, const TriangleMesh<double>& to) {
    double most = 0;
    for (Eigen::Index f = 0; f < from.faces.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int a = from.faces(f, k), b = from.faces(f, (k + 1) % 3);
            most = std::max(most, (core::point(to.vertices, a) - core::point(to.vertices, b)).norm() /
                                      (core::point(from.vertices, a) - core::point(from.vertices, b)).norm());
        }
    return most;
}

TEST_CASE("engine bones: who carries whom, and where they are", "[applications][engine]") {
    const Rig<double>& plain = plain_rig();
    const Rig<double>& rig = engine_rig();
    CHECK(rig.joints.size() == plain.joints.size() + 4);
    CHECK(rig.motions.size() == rig.joints.size());
    for (std::size_t j = 0; j < rig.joints.size(); ++j) CHECK(rig.joints[j].parent < static_cast<int>(j));
    CHECK(parent_of(rig, "root").empty());
    CHECK(parent_of(rig, "crotch") == "root");
    CHECK(parent_of(rig, "upper_chest") == "chest");
    CHECK(parent_of(rig, "neck") == "upper_chest");
    for (const std::string side : {"left_", "right_"}) {
        CHECK(parent_of(rig, side + "clavicle") == "upper_chest");
        CHECK(parent_of(rig, side + "shoulder") == side + "clavicle");
        CHECK(parent_of(rig, side + "elbow") == side + "shoulder");
        CHECK(parent_of(rig, side + "hip") == "crotch");
        const RigJoint<double>& clavicle = joint(rig, side + "clavicle");
        CHECK((clavicle.end - joint(plain, side + "shoulder").position).norm() < 1e-12);
        CHECK((clavicle.axes * Vec3::UnitY()).cross(clavicle.end - clavicle.position).norm() < 1e-9);
    }
    for (const RigJoint<double>& one : plain.joints) { // all that was there is where it was
        CHECK((joint(rig, one.name).position - one.position).norm() == 0);
        CHECK(joint(rig, one.name).axes.angularDistance(one.axes) == 0);
    }
    const Vec3 root = joint(rig, "root").position, hips = joint(rig, "crotch").position;
    CHECK(root[0] == hips[0]);
    CHECK(root[2] == hips[2]);
    CHECK(root[1] == Approx(plain.mesh.vertices.col(1).minCoeff()).margin(1e-12));
    const Vec3 chest = joint(rig, "chest").position, neck = joint(rig, "neck").position;
    CHECK((joint(rig, "upper_chest").position - (0.6 * chest + 0.4 * neck)).norm() < 1e-12);

    const Rig<double> twisted = with_engine_bones(plain, {false, true});
    CHECK(twisted.joints.size() == plain.joints.size() + 6);
    CHECK(parent_of(twisted, "left_forearm_twist") == "left_elbow");
    CHECK(parent_of(twisted, "right_upper_arm_twist") == "right_shoulder");
    CHECK(parent_of(twisted, "left_thigh_twist") == "left_hip");
    CHECK((joint(twisted, "left_forearm_twist").position -
           (joint(plain, "left_elbow").position + joint(plain, "left_wrist").position) / 2)
              .norm() < 1e-12);
    CHECK(with_engine_bones(plain, {true, true}).joints.size() == plain.joints.size() + 10);
    CHECK(with_engine_bones(rig, {true, false}).joints.size() == rig.joints.size()); // once is enough
    CHECK(with_engine_bones(plain, {}).joints.size() == plain.joints.size());
}

TEST_CASE("engine bones: weights sum to 1, are smooth, and the shoulder's surface is the clavicle's",
          "[applications][engine]") {
    const Rig<double> rig = with_engine_bones(plain_rig(), {true, true});
    for (Eigen::Index v = 0; v < rig.skin.weights.rows(); ++v) {
        CHECK(rig.skin.weights.row(v).sum() == Approx(1).margin(1e-9));
        std::set<int> used;
        for (int k = 0; k < 4; ++k)
            if (rig.skin.weights(v, k) > 0)
                CHECK(used.insert(rig.skin.joints(v, k)).second);
            else
                CHECK(rig.skin.joints(v, k) == 0);
    }
    for (const std::string side : {"left_", "right_"}) {
        const RigJoint<double>& clavicle = joint(rig, side + "clavicle");
        const double bone = (clavicle.end - clavicle.position).norm();
        double most = 0, step = 0, other_side = 0;
        for (Eigen::Index v = 0; v < rig.skin.weights.rows(); ++v) {
            const double here = weight(rig, v, side + "clavicle");
            most = std::max(most, here);
            if (sign_of(clavicle.side) * (rig.mesh.vertices(v, 0) - joint(rig, "crotch").position[0]) < -0.05)
                other_side = std::max(other_side, here);
        }
        // Of what the trunk has near an arm, how much the clavicle's is: what the arm has is cut off as it was.
        const auto share = [&](int v) {
            const double here = weight(rig, v, side + "clavicle");
            return here / (here + weight(rig, v, "chest") + weight(rig, v, "upper_chest"));
        };
        const auto of_trunk = [&](int v) { return weight(plain_rig(), v, "chest") > 0.2; };
        for (Eigen::Index f = 0; f < rig.mesh.faces.rows(); ++f) {
            const int one = rig.mesh.faces(f, 0), next = rig.mesh.faces(f, 1);
            const double length = (rig.mesh.vertices.row(one) - rig.mesh.vertices.row(next)).norm();
            if (of_trunk(one) && of_trunk(next))
                step = std::max(step, std::abs(share(one) - share(next)) / (length + 0.1 * bone));
        }
        CHECK(most > 0.6);
        CHECK(step < 2.75 / bone); // steepest along the bone 1.5, down from it 1.5 / 1.2
        CHECK(other_side == 0);
    }
}

TEST_CASE("engine bones: a clip moves all joints and the mesh as without them", "[applications][engine][clip]") {
    const Rig<double>& plain = plain_rig();
    const auto animation = retarget(walking_clip(), plain, human());
    REQUIRE(animation);
    for (const EngineBones& bones : {EngineBones{true, false}, EngineBones{true, true}}) {
        const Rig<double> rig = with_engine_bones(plain, bones);
        const Animation<double> with = with_engine_bones(*animation, plain, rig);
        REQUIRE(with.frames.size() == animation->frames.size());
        for (std::size_t f = 0; f < with.frames.size(); f += 5) {
            const auto a = motions(plain.joints, animation->frames[f]), b = motions(rig.joints, with.frames[f]);
            for (std::size_t j = 0; j < plain.joints.size(); ++j) {
                const RigJoint<double>& one = plain.joints[j];
                const std::size_t same = index_of(rig, one.name);
                CHECK((a[j](one.position) - b[same](one.position)).norm() < 1e-9);
                CHECK(a[j].rotation.angularDistance(b[same].rotation) < 1e-7);
            }
            CHECK(with.frames[f].root[1] == rig.joints.front().position[1]); // the root stays on the floor
            if (bones.twist) continue;
            const auto apart =
                (posed(plain, animation->frames[f]).vertices - posed(rig, with.frames[f]).vertices).eval();
            CHECK(apart.rowwise().norm().mean() < 2e-4); // metres: a vertex of more than four joints loses the fifth
            CHECK(apart.rowwise().norm().maxCoeff() < 0.02);
        }
    }
    CHECK_THROWS_AS(with_engine_bones(*animation, engine_rig(), plain), Error);
}

TEST_CASE("twist bones: half of what the hand turns, half of the upper arm's turn back", "[applications][engine]") {
    const Rig<double> plain = template_rig(RestPose::t_pose);
    const Rig<double> rig = with_engine_bones(plain, {false, true});
    const Vec3 along = joint(plain, "left_wrist").position - joint(plain, "left_elbow").position;
    const auto about = [](double degrees, const Vec3& axis) {
        return Eigen::Quaterniond(Eigen::AngleAxisd(degrees * std::numbers::pi / 180, axis.normalized()));
    };
    const auto turn_of = [&](const Animation<double>& animation, const std::string& name) {
        const std::size_t j = index_of(rig, name);
        return animation.frames[0].axes[j] * rig.joints[j].axes.conjugate();
    };
    const Vec3 upper = joint(plain, "left_elbow").position - joint(plain, "left_shoulder").position;
    const Animation<double> turned{"turned", 1, {held(plain, {{"left_wrist", about(80, along)}})}};
    const auto of_hand = with_engine_bones(turned, plain, rig);
    CHECK(turn_of(of_hand, "left_forearm_twist").angularDistance(about(40, along)) < 1e-9);
    CHECK(turn_of(of_hand, "right_forearm_twist").angularDistance(Eigen::Quaterniond::Identity()) < 1e-9);
    const Animation<double> rolled{"rolled", 1, {held(plain, {{"left_shoulder", about(60, upper)}})}};
    const auto of_arm = with_engine_bones(rolled, plain, rig);
    CHECK(turn_of(of_arm, "left_upper_arm_twist").angularDistance(about(30, upper)) < 1e-9);
    CHECK(turn_of(of_arm, "left_forearm_twist").angularDistance(turn_of(of_arm, "left_elbow")) < 1e-9);
}

TEST_CASE("engine bones: arms raised and lowered by 90 degrees keep round shoulders", "[applications][engine]") {
    const auto about_z = [](double degrees) {
        return Eigen::Quaterniond(Eigen::AngleAxisd(degrees * std::numbers::pi / 180, Vec3::UnitZ()));
    };
    const double at_rest = volume(plain_rig().mesh);
    for (const double angle : {90.0, -90.0}) {
        const auto by_arm = posed(
            plain_rig(), held(plain_rig(), {{"left_shoulder", about_z(angle)}, {"right_shoulder", about_z(-angle)}}));
        const double part = angle / 4; // of a shoulder's turn is the girdle's
        const auto by_girdle = posed(engine_rig(), held(engine_rig(), {{"left_clavicle", about_z(part)},
                                                                       {"left_shoulder", about_z(angle - part)},
                                                                       {"right_clavicle", about_z(-part)},
                                                                       {"right_shoulder", about_z(part - angle)}}));
        CAPTURE(angle, stretch(plain_rig().mesh, by_arm), stretch(plain_rig().mesh, by_girdle));
        CHECK(stretch(plain_rig().mesh, by_girdle) < stretch(plain_rig().mesh, by_arm));
        CHECK(stretch(plain_rig().mesh, by_girdle) < 2.8);
        CHECK(stretch(plain_rig().mesh, by_arm) < 3.1);               // nearly: it ends within its rounds
        CHECK(volume(by_girdle) / at_rest == Approx(1).margin(0.12)); // with shoulders lifted or drawn down
    }
}

TEST_CASE("engine bones have the names that engines know them by", "[applications][engine][io]") {
    const auto named = [](io::JointNames convention) {
        const Rig<double> rig = with_engine_bones(template_rig(RestPose::t_pose), {true, true});
        std::vector<std::string> out;
        const auto names = io::names_of(rig.joints, convention);
        for (const char* one : {"root", "waist", "chest", "upper_chest", "left_clavicle", "left_shoulder"})
            out.push_back(names[index_of(rig, one)]);
        CHECK(std::set<std::string>(names.begin(), names.end()).size() == names.size());
        return out;
    };
    using Names = std::vector<std::string>;
    using enum io::JointNames;
    CHECK(named(mixamo) == Names{"root", "Spine", "Spine1", "Spine2", "LeftShoulder", "LeftArm"});
    CHECK(named(unreal) == Names{"root", "spine_01", "spine_02", "spine_03", "clavicle_l", "upperarm_l"});
    CHECK(named(unity) == Names{"root", "Spine", "Chest", "UpperChest", "LeftShoulder", "LeftUpperArm"});
    CHECK(named(godot) == Names{"Root", "Spine", "Chest", "UpperChest", "LeftShoulder", "LeftUpperArm"});
    CHECK(named(vrm) == Names{"root", "spine", "chest", "upperChest", "leftShoulder", "leftUpperArm"});
    CHECK(named(rigify) == Names{"root", "spine.001", "spine.002", "spine.003", "shoulder.L", "upper_arm.L"});
    CHECK(named(smplx) == Names{"root", "spine1", "spine2", "spine3", "left_collar", "left_shoulder"});
    CHECK(named(skelgen) == Names{"root", "waist", "chest", "upper_chest", "left_clavicle", "left_shoulder"});
}

} // namespace
