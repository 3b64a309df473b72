#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <skelgen/applications/retarget.hpp>
#include <skelgen/core/error.hpp>
#include <skelgen/core/shortest_turn.hpp>
#include <skelgen/io/bvh.hpp>
#include <skelgen/io/rig_formats.hpp>

#include "catch.hpp"
#include "human.hpp"
#include "shapes.hpp"
#include "template_rig.hpp"
#include "walking_clip.hpp"

namespace {

using namespace skelgen;
using namespace skelgen::applications;
using test::human;
using Vec = Eigen::Vector3d;

/// Our joints whose bones have to point as the clip's, and the ends of those.
const std::vector<std::pair<std::string, std::pair<std::string, std::string>>> bones{
    {"left_shoulder", {"LeftArm", "LeftForeArm"}},    {"left_elbow", {"LeftForeArm", "LeftHand"}},
    {"right_shoulder", {"RightArm", "RightForeArm"}}, {"right_elbow", {"RightForeArm", "RightHand"}},
    {"left_hip", {"LeftUpLeg", "LeftLeg"}},           {"left_knee", {"LeftLeg", "LeftFoot"}},
    {"right_hip", {"RightUpLeg", "RightLeg"}},        {"right_knee", {"RightLeg", "RightFoot"}}};

std::size_t index_of(const std::string& joint) {
    for (std::size_t j = 0; j < human().joints.size(); ++j)
        if (human().joints[j].name == joint) return j;
    throw std::out_of_range(joint);
}

Vec place(const MotionClip& clip, const ClipPose& pose, const std::string& joint) {
    for (std::size_t j = 0; j < clip.joints.size(); ++j)
        if (clip.joints[j].name == joint) return pose.positions[j];
    throw std::out_of_range(joint);
}

Animation<double> followed(const MotionClip& clip, const Rig<double>& rig) {
    auto animation = retarget(clip, rig, human());
    if (!animation) FAIL(animation.failure().what);
    return *animation;
}

/// The largest angle, in radians, between the axes that joints have in the frames of two animations.
double largest_turn(const Animation<double>& a, const Animation<double>& b) {
    REQUIRE(a.frames.size() == b.frames.size());
    double most = 0;
    for (std::size_t f = 0; f < a.frames.size(); ++f)
        for (std::size_t j = 0; j < human().joints.size(); ++j)
            most = std::max(most, a.frames[f].axes[j].angularDistance(b.frames[f].axes[j]));
    return most;
}

double largest_step(const Animation<double>& a, const Animation<double>& b) {
    double most = 0;
    for (std::size_t f = 0; f < a.frames.size(); ++f)
        most = std::max(most, (a.frames[f].root - b.frames[f].root).norm());
    return most;
}

TEST_CASE("retargeting: limbs point as the clip's, whatever the rest poses", "[applications][clip]") {
    const MotionClip clip = test::walking_clip();
    for (const RestPose rest : {RestPose::t_pose, RestPose::a_pose}) {
        const Rig<double> rig = test::template_rig(rest);
        const Animation<double> animation = followed(clip, rig);
        REQUIRE(animation.frames.size() == 30);
        CHECK(animation.seconds_per_frame == clip.seconds_per_frame);
        for (std::size_t f = 0; f < 30; f += 7) {
            const ClipPose pose = pose_in(clip, f);
            const auto motion = motions(rig.joints, animation.frames[f]);
            for (const auto& [joint, ends] : bones) {
                const std::size_t j = index_of(joint);
                const Vec ours = motion[j](rig.joints[j].end) - motion[j](rig.joints[j].position);
                const Vec theirs = place(clip, pose, ends.second) - place(clip, pose, ends.first);
                CHECK((ours.normalized() - theirs.normalized()).norm() < 1e-9);
            }
        }
    }
}

TEST_CASE("retargeting: the clip's rest pose holds trunk, head, hands and feet as ours does", "[applications][clip]") {
    const MotionClip clip = test::standing_clip();
    const Rig<double> rig = test::template_rig(RestPose::t_pose);
    const Animation<double> animation = followed(clip, rig);
    for (const char* joint : {"crotch", "waist", "chest", "neck", "head", "left_shoulder", "left_hand", "right_wrist",
                              "left_ankle", "right_foot"}) {
        INFO(joint);
        CHECK(animation.frames[0].axes[index_of(joint)].angularDistance(rig.joints[index_of(joint)].axes) < 1e-6);
    }
    CHECK((animation.frames[0].root - rig.joints[0].position - Vec(0, -0.015, 0)).norm() < 1e-2);

    // A forearm turned about itself, a foot lifted, a head that nods, shoulders turned against the hips.
    MotionClip turned = clip;
    test::turn_of(turned, 0, "LeftForeArm", 1) = 50;
    test::turn_of(turned, 0, "RightFoot", 1) = -20;
    test::turn_of(turned, 0, "Head", 1) = 30;
    test::turn_of(turned, 0, "Spine2", 2) = 40;
    const auto& axes = followed(turned, rig).frames[0].axes;
    const auto angle = [&](const char* joint) {
        const std::size_t j = index_of(joint);
        const Eigen::Quaterniond chest(Eigen::AngleAxisd(40 * test::pi / 180, Vec::UnitY()));
        const bool is_above = human().joints[j].name != "right_ankle";
        const Eigen::Quaterniond from = (is_above ? chest : Eigen::Quaterniond::Identity()) * rig.joints[j].axes;
        return from.angularDistance(axes[j]) * 180 / test::pi;
    };
    CHECK(angle("chest") == Approx(0).margin(1e-5));
    CHECK(angle("left_elbow") == Approx(50));
    CHECK(angle("left_shoulder") == Approx(0).margin(1e-5));
    CHECK(angle("head") == Approx(30));
    CHECK(angle("right_ankle") == Approx(20));
}

TEST_CASE("retargeting: our own skeleton, written as BVH and read back, moves nothing", "[applications][clip]") {
    for (const RestPose rest : {RestPose::t_pose, RestPose::a_pose}) {
        const Rig<double> rig = test::template_rig(rest);
        for (const io::JointNames names : {io::JointNames::skelgen, io::JointNames::mixamo}) {
            const MotionClip clip = io::parse_bvh(io::rig_to_bvh(rig, names));
            const auto pose = pose_in(clip, 0);
            for (std::size_t j = 0; j < rig.joints.size(); ++j)
                CHECK((pose.positions[j] / 100 - rig.joints[j].position).norm() < 1e-9);
            const TriangleMesh<double> back = posed(rig, followed(clip, rig).frames[0]);
            const Vec shift(0, rig.mesh.vertices.col(1).minCoeff(), 0); // to the floor
            CHECK((back.vertices.rowwise() + shift.transpose() - rig.mesh.vertices).rowwise().norm().maxCoeff() < 1e-6);
        }
    }
}

TEST_CASE("retargeting: the clip's unit, place, heading and upright axis do not count", "[applications][clip]") {
    const MotionClip clip = test::walking_clip();
    const Rig<double> rig = test::template_rig(RestPose::a_pose);
    const Animation<double> animation = followed(clip, rig);
    // In metres, z up, facing -y: the axes x, y, z become x, z and -y.
    MotionClip other = clip;
    const auto turned = [](const Vec& p) { return Vec(p.x(), -p.z(), p.y()); };
    for (ClipJoint& joint : other.joints) {
        joint.offset = turned(joint.offset) / 100;
        if (joint.end) joint.end = turned(*joint.end) / 100;
        for (ClipChannel& channel : joint.channels) {
            if (channel == ClipChannel::y_rotation)
                channel = ClipChannel::z_rotation;
            else if (channel == ClipChannel::z_rotation)
                channel = ClipChannel::y_rotation; // about -y: the numbers change their sign below
        }
    }
    Eigen::Index column = 3;
    for (std::size_t j = 0; j < other.joints.size(); ++j, column += 3) other.frames.col(column) *= -1;
    for (Eigen::Index f = 0; f < clip.frames.rows(); ++f) {
        const Vec root = clip.frames.row(f).head<3>().transpose();
        other.frames.row(f).head<3>() = (turned(root) / 100 + Vec(7, -3, 2)).transpose();
    }
    const Animation<double> same = followed(other, rig);
    CHECK(largest_turn(animation, same) < 1e-6);
    CHECK(largest_step(animation, same) < 1e-9);
}

TEST_CASE("retargeting: bones folded into a line at rest", "[applications][clip]") {
    // Some programs write each joint's axes into the motion: at rest all bones then lie along x.
    const MotionClip clip = test::walking_clip();
    MotionClip folded = clip;
    std::vector<Eigen::Quaterniond> to_line; // per joint from its bone's axes to those of the clip at rest
    for (std::size_t j = 0; j < clip.joints.size(); ++j) {
        Vec bone = clip.joints[j].end.value_or(Vec::UnitX());
        for (const ClipJoint& child : clip.joints)
            if (child.parent == static_cast<int>(j) && child.offset.x() == 0) bone = child.offset;
        if (clip.joints[j].name.ends_with("Arm") || clip.joints[j].name.ends_with("Shoulder"))
            bone = clip.joints[j + 1].offset;
        to_line.push_back(core::shortest_turn<double>(Vec::UnitX(), bone));
    }
    for (std::size_t j = 0; j < clip.joints.size(); ++j) {
        const int parent = clip.joints[j].parent;
        if (parent >= 0)
            folded.joints[j].offset = to_line[static_cast<std::size_t>(parent)].conjugate() * clip.joints[j].offset;
        if (clip.joints[j].end) folded.joints[j].end = to_line[j].conjugate() * *clip.joints[j].end;
    }
    for (Eigen::Index f = 0; f < clip.frames.rows(); ++f) {
        const ClipPose pose = pose_in(clip, static_cast<std::size_t>(f));
        for (std::size_t j = 0; j < clip.joints.size(); ++j) {
            Eigen::Quaterniond turn = pose.turns[j] * to_line[j];
            if (const int parent = clip.joints[j].parent; parent >= 0) {
                const auto above = static_cast<std::size_t>(parent);
                turn = (pose.turns[above] * to_line[above]).conjugate() * turn;
            }
            folded.frames.row(f).segment<3>(static_cast<Eigen::Index>(3 + 3 * j)) =
                turn.toRotationMatrix().eulerAngles(2, 0, 1).transpose() * 180 / test::pi;
        }
    }
    const Rig<double> rig = test::template_rig(RestPose::t_pose);
    const Animation<double> wanted = followed(clip, rig), found = followed(folded, rig);
    for (std::size_t f = 0; f < wanted.frames.size(); ++f)
        for (const auto& [joint, ends] : bones) {
            const std::size_t j = index_of(joint);
            const Vec a = wanted.frames[f].axes[j] * Vec::UnitY(), b = found.frames[f].axes[j] * Vec::UnitY();
            CHECK((a - b).norm() < 1e-6);
        }
    CHECK(largest_turn(wanted, found) < 0.5); // how bones are turned about themselves is seen in the first frame alone
}

TEST_CASE("retargeting: steps are as long as the legs, and feet come to the floor", "[applications][clip]") {
    MotionClip clip = test::walking_clip();
    const Rig<double> rig = test::template_rig(RestPose::t_pose);
    const Animation<double> animation = followed(clip, rig);
    CHECK(animation.frames.front().root.x() == Approx(0).margin(1e-12));
    CHECK(animation.frames.front().root.z() == Approx(0).margin(1e-12));
    const double walked = (clip.frames(29, 2) - clip.frames(0, 2)) / 81; // in legs' lengths, nearly
    CHECK(animation.frames.back().root.z() == Approx(walked * 0.8).epsilon(0.02));

    const auto lowest = [&](const Animation<double>& of, std::size_t f) {
        return posed(rig, of.frames[f]).vertices.col(1).minCoeff();
    };
    std::vector<double> heights;
    for (std::size_t f = 0; f < 30; ++f) heights.push_back(lowest(animation, f));
    CHECK(*std::min_element(heights.begin(), heights.end()) > -0.02);
    CHECK(*std::max_element(heights.begin(), heights.end()) < 0.06);
    CHECK(std::count_if(heights.begin(), heights.end(), [](double h) { return h < -1e-9; }) <= 1);

    clip.frames(3, 1) -= 50; // an odd frame, and a jump
    clip.frames(20, 1) += 50;
    const Animation<double> odd = followed(clip, rig);
    CHECK(lowest(odd, 3) < -0.4);
    CHECK(lowest(odd, 20) > 0.4);
    CHECK(std::abs(lowest(odd, 10) - heights[10]) < 0.02);
}

TEST_CASE("retargeting: single precision", "[applications][clip]") {
    const Rig<double> rig = test::template_rig(RestPose::a_pose);
    Rig<float> single;
    single.mesh = {rig.mesh.vertices.cast<float>(), rig.mesh.faces};
    single.skin.joints = rig.skin.joints;
    single.skin.weights = rig.skin.weights.cast<float>();
    for (const RigJoint<double>& joint : rig.joints)
        single.joints.push_back({joint.name, joint.parent, joint.role, joint.side, joint.position.cast<float>(),
                                 joint.end.cast<float>(), joint.axes.cast<float>(), joint.confidence,
                                 joint.orientation.cast<float>()});
    const Animation<double> wanted = followed(test::walking_clip(), rig);
    const auto found = retarget(test::walking_clip(), single, human());
    REQUIRE(found);
    for (std::size_t f = 0; f < wanted.frames.size(); f += 5)
        CHECK((posed(single, found->frames[f]).vertices.cast<double>() - posed(rig, wanted.frames[f]).vertices)
                  .cwiseAbs()
                  .maxCoeff() < 1e-5);
}

TEST_CASE("retargeting: what cannot be followed is refused with the reason", "[applications][clip]") {
    const Rig<double> rig = test::template_rig(RestPose::t_pose);
    const auto fault = [&](const MotionClip& clip) {
        const auto animation = retarget(clip, rig, human());
        return animation ? std::string() : animation.failure().what;
    };
    MotionClip mirrored = test::walking_clip();
    for (ClipJoint& joint : mirrored.joints) joint.offset.x() *= -1;
    CHECK_THAT(fault(mirrored), Catch::Matchers::Contains("left and right are exchanged"));
    MotionClip nameless = test::walking_clip();
    for (ClipJoint& joint : nameless.joints) joint.name = "joint";
    CHECK_THAT(fault(nameless), Catch::Matchers::Contains("no joint is named"));
    MotionClip flat = test::walking_clip();
    for (ClipJoint& joint : flat.joints) joint.offset.setZero();
    CHECK_THAT(fault(flat), Catch::Matchers::Contains("without length"));
    MotionClip far = test::walking_clip(); // beside what it walks, its legs are nothing
    for (ClipJoint& joint : far.joints) joint.offset *= 1e-30;
    far.frames(1, 0) = 3e38;
    CHECK_THAT(fault(far), Catch::Matchers::Contains("too far to compute with in frame 1"));
    CHECK_THROWS_AS(retarget(test::walking_clip(), rig, builtin_template("pinocchio18")), Error);
    MotionClip short_of_numbers = test::walking_clip();
    short_of_numbers.frames.conservativeResize(Eigen::NoChange, 6);
    CHECK_THROWS_AS(retarget(short_of_numbers, rig, human()), Error);
    RigPose<double> no_pose;
    CHECK_THROWS_AS(motions(rig.joints, no_pose), Error);
}

} // namespace
