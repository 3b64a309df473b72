#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include <skelgen/core/template_rules.hpp>
#include <skelgen/symmetry/sides.hpp>
#include <skelgen/symmetry/sides_table.hpp>

#include "catch.hpp"
#include "symmetry/posed_template.hpp"

using namespace skelgen;
using namespace skelgen::symmetry;
using namespace skelgen::test;
using Joints = skelgen::refinement::RefinedJoints<double>;

namespace {

double degrees_between(const Vector3<double>& a, const Vector3<double>& b) {
    return std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / std::numbers::pi;
}

/// The same joints with the names left and right exchanged where `which` says so.
Joints relabelled(const Joints& joints, const std::function<bool(JointRole)>& which) {
    const auto& human = builtin_template("human21").joints;
    std::vector<std::size_t> other(human.size());
    for (std::size_t j = 0; j < human.size(); ++j) {
        other[j] = j;
        for (std::size_t k = 0; k < human.size(); ++k)
            if (human[j].side != Side::none && which(human[j].role) && human[k].role == human[j].role &&
                human[k].side != human[j].side)
                other[j] = k;
    }
    Joints out = joints;
    for (std::size_t j = 0; j < human.size(); ++j) {
        out.positions.row(static_cast<Eigen::Index>(j)) = joints.positions.row(static_cast<Eigen::Index>(other[j]));
    }
    for (auto& [joint, tip] : out.tips) joint = static_cast<int>(other[static_cast<std::size_t>(joint)]);
    return out;
}

void check_is_frame(const BodyFrame<double>& frame) {
    CHECK(frame.left.norm() == Approx(1));
    CHECK(frame.forward.norm() == Approx(1));
    CHECK(frame.up.norm() == Approx(1));
    CHECK((frame.left.cross(frame.forward) + frame.up).norm() < 1e-9); // a left-handed triple
}

void check_frame(const BodyFrame<double>& frame, const BodyFrame<double>& expected) {
    check_is_frame(frame);
    CHECK((frame.origin - expected.origin).norm() < 1e-12);
    CHECK(degrees_between(frame.left, expected.left) < 20);
    CHECK(degrees_between(frame.forward, expected.forward) < 20);
    CHECK(degrees_between(frame.up, expected.up) < 20);
}

Eigen::RowVector3d middle_of_hips(const Joints& joints) {
    const auto& human = builtin_template("human21").joints;
    Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
    for (std::size_t j = 0; j < human.size(); ++j)
        if (human[j].role == JointRole::hip) sum += joints.positions.row(static_cast<Eigen::Index>(j)) / 2;
    return sum;
}

SidesDecision<double> decide(const Joints& joints) {
    const Outcome<SidesDecision<double>> sides = decide_sides(joints, builtin_template("human21"));
    REQUIRE(sides);
    return *sides;
}

bool has_no_extent(const Joints& joints) {
    const Outcome<SidesDecision<double>> sides = decide_sides(joints, builtin_template("human21"));
    return !sides && sides.failure().reason == Refusal::flat_trunk &&
           sides.failure().what.find("no extent") != std::string::npos;
}

/// The template's own rest pose as if it had been refined.
Joints rest_pose(const SkeletonTemplate& skeleton_template) {
    Joints joints;
    const auto n = static_cast<Eigen::Index>(skeleton_template.joints.size());
    joints.positions.resize(n, 3);
    for (Eigen::Index j = 0; j < n; ++j) {
        const TemplateJoint& joint = skeleton_template.joints[static_cast<std::size_t>(j)];
        joints.positions.row(j) = joint.position.transpose();
        if (joint.tip) joints.tips.emplace_back(static_cast<int>(j), *joint.tip);
    }
    return joints;
}

/// human21 without joints of these roles, their children on their parents.
SkeletonTemplate without(const std::vector<JointRole>& roles) {
    const SkeletonTemplate& human = builtin_template("human21");
    SkeletonTemplate out{"fewer joints", {}};
    std::vector<int> index(human.joints.size(), -1);
    for (std::size_t j = 0; j < human.joints.size(); ++j) {
        TemplateJoint joint = human.joints[j];
        const int parent = joint.parent < 0 ? -1 : index[static_cast<std::size_t>(joint.parent)];
        const bool is_left_out = std::find(roles.begin(), roles.end(), joint.role) != roles.end();
        index[j] = is_left_out ? parent : static_cast<int>(out.joints.size());
        joint.parent = parent;
        if (!is_left_out) out.joints.push_back(joint);
    }
    return out;
}

/// Legs and feet straight down, arms straight.
Joints standing_straight() {
    Joints joints = posed(test_poses()[0]).joints;
    const auto& human = builtin_template("human21").joints;
    for (std::size_t j = 0; j < human.size(); ++j)
        if (human[j].role == JointRole::knee || human[j].role == JointRole::ankle || human[j].role == JointRole::foot) {
            const auto row = static_cast<Eigen::Index>(j);
            joints.positions.row(row) = joints.positions.row(human[j].parent) - Eigen::RowVector3d(0, 0.3, 0);
            for (auto& [end, tip] : joints.tips)
                if (end == static_cast<int>(j))
                    tip = joints.positions.row(row).transpose() - Vector3<double>(0, 0.1, 0);
        }
    return joints;
}

} // namespace

TEST_CASE("labels that are right stay, in every pose, however the body lies") {
    for (const TestPose& pose : test_poses()) {
        int orientation = 0;
        for (const Eigen::Matrix3d& rotation : test_orientations()) {
            INFO(pose.name << ", orientation " << orientation++);
            const PosedBody body = posed(pose, rotation);
            const SidesDecision<double> sides = decide(body.joints);
            CHECK_FALSE(sides.swap_legs);
            CHECK_FALSE(sides.swap_arms);
            CHECK(sides.confidence >= 0);
            CHECK(sides.confidence <= 1);
            check_frame(sides.frame, body.frame);
        }
    }
}

TEST_CASE("labels that are exchanged are put right: all, the legs' alone, the arms' alone") {
    for (const TestPose& pose : test_poses()) {
        const PosedBody body = posed(pose, test_orientations().back());
        const SidesDecision<double> right = decide(body.joints);
        for (const bool legs : {false, true})
            for (const bool arms : {false, true}) {
                INFO(pose.name << (legs ? ", legs" : "") << (arms ? ", arms" : "") << " exchanged");
                const Joints wrong = relabelled(
                    body.joints, [&](JointRole role) { return part_of(role) == BodyPart::leg ? legs : arms; });
                const SidesDecision<double> sides = decide(wrong);
                CHECK(sides.swap_legs == legs);
                CHECK(sides.swap_arms == arms);
                CHECK((sides.frame.left - right.frame.left).norm() < 1e-9);
                CHECK((sides.frame.forward - right.frame.forward).norm() < 1e-9);
                const KinematicSkeleton<double> skeleton = assemble(wrong, builtin_template("human21"), sides);
                for (std::size_t j = 0; j < skeleton.joints.size(); ++j)
                    CHECK(skeleton.joints[j].position ==
                          body.joints.positions.row(static_cast<Eigen::Index>(j)).transpose());
            }
    }
}

TEST_CASE("a mirror image has its sides exchanged") {
    for (const TestPose& pose : test_poses()) {
        INFO(pose.name);
        PosedBody body = posed(pose);
        body.joints.positions.col(0) *= -1;
        for (auto& [joint, tip] : body.joints.tips) tip.x() *= -1;
        const SidesDecision<double> sides = decide(body.joints);
        CHECK(sides.swap_legs);
        CHECK(sides.swap_arms);
    }
}

TEST_CASE("size does not matter") {
    for (const double scale : {1e-3, 1e3}) {
        PosedBody body = posed(test_poses()[2]);
        const SidesDecision<double> expected = decide(body.joints);
        body.joints.positions *= scale;
        for (auto& [joint, tip] : body.joints.tips) tip *= scale;
        const SidesDecision<double> sides = decide(body.joints);
        CHECK(sides.swap_legs == expected.swap_legs);
        CHECK(sides.confidence == Approx(expected.confidence));
        CHECK((sides.frame.forward - expected.frame.forward).norm() < 1e-9);
    }
}

TEST_CASE("who stands straight is told by joints, and surely by the surface; turned feet leave doubt") {
    const Joints standing = posed(test_poses()[0]).joints;
    CHECK(decide(standing).confidence > 0.5);
    SurfaceFront<double> front;
    front.sole = 1.5 * Vector3<double>::UnitZ(); // of 2 at most
    CHECK(decide_sides(standing, builtin_template("human21"), front)->confidence > 0.9);
    TestPose contradictory{"one foot forward, one backward", {{"left_ankle", {0, 0, 170}}}};
    CHECK(decide(posed(contradictory).joints).confidence < 0.5);
}

TEST_CASE("the head tells the sides where feet and knees say nothing") {
    Joints right = standing_straight();
    const double undecided = decide(right).confidence;
    right.head.emplace();
    right.head->forward = Vector3<double>::UnitZ();
    right.head->frontness = 0.1;
    const Joints wrong = relabelled(right, [](JointRole) { return true; });
    CHECK_FALSE(decide(right).swap_legs);
    CHECK(decide(wrong).swap_legs);
    CHECK(decide(wrong).swap_arms);
    CHECK(decide(right).confidence > undecided);
    CHECK(degrees_between(decide(right).frame.forward, Vector3<double>::UnitZ()) < 5);
    CHECK(degrees_between(decide(wrong).frame.forward, Vector3<double>::UnitZ()) < 5);
}

TEST_CASE("feet and face of the surface tell the sides, each alone, and no more than they may") {
    const Joints joints = standing_straight();
    const double undecided = decide(joints).confidence;
    CHECK(undecided < 0.2);
    for (const SideWitness witness : {SideWitness::sole, SideWitness::face}) {
        INFO(to_string(witness));
        const auto w = static_cast<std::size_t>(witness);
        double last = undecided;
        for (const double shown : {0.2, 0.9, 2.0, 5.0}) { // parts of what counts at most
            SurfaceFront<double> front;
            (witness == SideWitness::sole ? front.sole : front.face) =
                shown * side_limits[w] * Vector3<double>::UnitZ();
            const auto right = decide_sides(joints, builtin_template("human21"), front);
            REQUIRE(right);
            CHECK_FALSE(right->swap_legs);
            CHECK(right->evidence[witness] == Approx(shown * side_limits[w]).epsilon(0.01));
            CHECK((shown > 2 ? right->confidence == Approx(last) : right->confidence > last));
            last = right->confidence;
            const auto wrong =
                decide_sides(relabelled(joints, [](JointRole) { return true; }), builtin_template("human21"), front);
            REQUIRE(wrong);
            CHECK(wrong->swap_legs);
            CHECK(wrong->swap_arms);
            CHECK(wrong->confidence == Approx(right->confidence));
        }
    }
}

TEST_CASE("the votes are the log odds of the confidence, for the sides as decided") {
    for (const TestPose& pose : test_poses())
        for (const bool exchanged : {false, true}) {
            INFO(pose.name);
            const PosedBody body = posed(pose);
            const SidesDecision<double> sides = decide(relabelled(body.joints, [&](JointRole) { return exchanged; }));
            double sum = 0;
            for (const SideVote& vote : votes_of(sides.evidence)) {
                CHECK(vote.strength != 0);
                sum += vote.strength;
            }
            CHECK(core::log_odds((1 + sides.confidence) / 2) == Approx(sum));
        }
    CHECK(votes_of({}).empty());
}

TEST_CASE("the skeleton has the template's names, order and parents, and the end points in a fixed order") {
    const PosedBody body = posed(test_poses()[0]);
    const SkeletonTemplate& human = builtin_template("human21");
    const KinematicSkeleton<double> skeleton = assemble(body.joints, human, decide(body.joints));
    CHECK(skeleton.template_name == "human21");
    REQUIRE(skeleton.joints.size() == 21);
    for (std::size_t j = 0; j < 21; ++j) {
        CHECK(skeleton.joints[j].name == human.joints[j].name);
        CHECK(skeleton.joints[j].parent == human.joints[j].parent);
    }
    std::vector<std::string> names;
    for (const auto& [name, point] : skeleton.end_points) names.push_back(name);
    CHECK(names == std::vector<std::string>{"head_top", "left_fingertip", "right_fingertip", "left_toe", "right_toe"});
}

TEST_CASE("a body without extent has no sides") {
    Joints no_hips = posed(test_poses()[0]).joints;
    const auto& human = builtin_template("human21").joints;
    for (std::size_t j = 0; j < human.size(); ++j)
        if (human[j].role == JointRole::hip)
            no_hips.positions.row(static_cast<Eigen::Index>(j)) = no_hips.positions.row(0);
    CHECK(has_no_extent(no_hips));

    Joints no_trunk = posed(test_poses()[0]).joints;
    for (std::size_t j = 0; j < human.size(); ++j)
        if (human[j].role == JointRole::waist)
            no_trunk.positions.row(static_cast<Eigen::Index>(j)) = middle_of_hips(no_trunk);
    CHECK(has_no_extent(no_trunk));

    Joints point = posed(test_poses()[0]).joints;
    point.positions.setZero();
    for (auto& [joint, tip] : point.tips) tip.setZero();
    CHECK(has_no_extent(point));
}

TEST_CASE("a template without neck and wrists is told as well") {
    const SkeletonTemplate& other = builtin_template("pinocchio18");
    const auto sides = decide_sides(rest_pose(other), other);
    REQUIRE(sides);
    CHECK_FALSE(sides->swap_legs);
    CHECK_FALSE(sides->swap_arms);
    CHECK(degrees_between(sides->frame.left, Vector3<double>::UnitX()) < 20);
}

TEST_CASE("arms are told by the first joint that they have, whichever the template leaves out") {
    using enum JointRole;
    const std::vector<std::vector<JointRole>> left_out{
        {shoulder}, {shoulder, elbow}, {shoulder, elbow, wrist}, {waist, neck, ankle}};
    for (const std::vector<JointRole>& roles : left_out) {
        const SkeletonTemplate other = without(roles);
        validate_template(other);
        INFO(roles.size() << " roles left out");
        const Joints joints = rest_pose(other);
        Joints exchanged = joints;
        for (int j = 0; j < static_cast<int>(other.joints.size()); ++j)
            if (part_of(other.joint(j).role) == BodyPart::arm)
                exchanged.positions.row(j) = joints.positions.row(counterpart(other, j));
        for (auto& [joint, tip] : exchanged.tips)
            if (other.joint(joint).role == hand) joint = counterpart(other, joint);
        const auto sides = decide_sides(joints, other), put_right = decide_sides(exchanged, other);
        REQUIRE(sides);
        REQUIRE(put_right);
        CHECK_FALSE(sides->swap_arms);
        CHECK(put_right->swap_arms);
        CHECK_FALSE(put_right->swap_legs);
        const KinematicSkeleton<double> skeleton = assemble(exchanged, other, *put_right);
        for (std::size_t j = 0; j < skeleton.joints.size(); ++j)
            CHECK(skeleton.joints[j].position == other.joints[j].position);
        for (const auto& [name, point] : skeleton.end_points)
            if (name == "left_fingertip") CHECK(point.x() > 0);
    }
}

TEST_CASE("in float, sides and frame are the same") {
    for (const TestPose& pose : test_poses()) {
        INFO(pose.name);
        const PosedBody body = posed(pose, test_orientations().back());
        const SidesDecision<double> expected = decide(body.joints);
        const auto sides = decide_sides(in_precision<float>(body.joints), builtin_template("human21"));
        REQUIRE(sides);
        CHECK(sides->swap_legs == expected.swap_legs);
        CHECK(sides->swap_arms == expected.swap_arms);
        CHECK(sides->confidence == Approx(expected.confidence).margin(1e-4));
        CHECK((sides->frame.left.cast<double>() - expected.frame.left).norm() < 1e-4);
        CHECK((sides->frame.forward.cast<double>() - expected.frame.forward).norm() < 1e-4);
        CHECK((sides->frame.up.cast<double>() - expected.frame.up).norm() < 1e-4);
    }
}

TEST_CASE("sides are told without feet and hands, which have neither votes nor end points") {
    const SkeletonTemplate& human = builtin_template("human21");
    TestPose pose_of_legs;
    for (const TestPose& pose : test_poses())
        if (pose.name == "running") pose_of_legs = pose;
    const PosedBody running = posed(pose_of_legs);
    Joints joints = running.joints;
    joints.is_present.assign(human.joints.size(), true);
    joints.tips.clear();
    for (std::size_t j = 0; j < human.joints.size(); ++j) {
        const JointRole role = human.joints[j].role;
        if (role == JointRole::foot || role == JointRole::hand) joints.is_present[j] = false;
    }
    const SidesDecision<double> sides = decide(joints);
    for (const SideVote& vote : votes_of(sides.evidence)) CHECK(vote.witness != "foot");
    CHECK_FALSE(sides.swap_legs);
    CHECK_FALSE(sides.swap_arms);
    check_frame(sides.frame, running.frame);
    const auto skeleton = assemble(joints, human, sides);
    CHECK(skeleton.end_points.empty());
    for (const Joint<double>& joint : skeleton.joints) {
        const bool cut = joint.name.find("hand") != std::string::npos || joint.name.find("foot") != std::string::npos;
        CHECK(joint.is_present != cut);
    }
    CHECK(std::count(skeleton.quality.warnings.begin(), skeleton.quality.warnings.end(),
                     "joint left_foot is missing: the surface ends before it") == 1);
}
