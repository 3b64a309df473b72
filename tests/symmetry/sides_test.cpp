#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include <skelgen/core/error.hpp>
#include <skelgen/symmetry/sides.hpp>

#include "catch.hpp"
#include "symmetry/posed_template.hpp"

using namespace skelgen;
using namespace skelgen::test;

namespace {

double degrees_between(const Vector3<double>& a, const Vector3<double>& b) {
    return std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / std::numbers::pi;
}

bool is_leg(JointRole role) {
    return role == JointRole::hip || role == JointRole::knee || role == JointRole::ankle || role == JointRole::foot;
}

/// The same joints with the names left and right exchanged where `which` says so.
RefinedJoints relabelled(const RefinedJoints& joints, const std::function<bool(JointRole)>& which) {
    const auto& human = builtin_template("human21").joints;
    std::vector<std::size_t> other(human.size());
    for (std::size_t j = 0; j < human.size(); ++j) {
        other[j] = j;
        for (std::size_t k = 0; k < human.size(); ++k)
            if (human[j].side != Side::none && which(human[j].role) && human[k].role == human[j].role &&
                human[k].side != human[j].side)
                other[j] = k;
    }
    RefinedJoints out = joints;
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

Eigen::RowVector3d middle_of_hips(const RefinedJoints& joints) {
    const auto& human = builtin_template("human21").joints;
    Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
    for (std::size_t j = 0; j < human.size(); ++j)
        if (human[j].role == JointRole::hip) sum += joints.positions.row(static_cast<Eigen::Index>(j)) / 2;
    return sum;
}

SidesDecision decide(const RefinedJoints& joints) { return decide_sides(joints, builtin_template("human21")); }

ErrorCode error_of(const RefinedJoints& joints) {
    try {
        static_cast<void>(decide(joints));
    } catch (const Error& error) {
        return error.code();
    }
    return ErrorCode::internal;
}

} // namespace

TEST_CASE("labels that are right stay, in every pose, however the body lies") {
    for (const TestPose& pose : test_poses()) {
        int orientation = 0;
        for (const Eigen::Matrix3d& rotation : test_orientations()) {
            INFO(pose.name << ", orientation " << orientation++);
            const PosedBody body = posed(pose, rotation);
            const SidesDecision sides = decide(body.joints);
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
        const SidesDecision right = decide(body.joints);
        for (const bool legs : {false, true})
            for (const bool arms : {false, true}) {
                INFO(pose.name << (legs ? ", legs" : "") << (arms ? ", arms" : "") << " exchanged");
                const RefinedJoints wrong =
                    relabelled(body.joints, [&](JointRole role) { return is_leg(role) ? legs : arms; });
                const SidesDecision sides = decide(wrong);
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
        const SidesDecision sides = decide(body.joints);
        CHECK(sides.swap_legs);
        CHECK(sides.swap_arms);
    }
}

TEST_CASE("size does not matter") {
    for (const double scale : {1e-3, 1e3}) {
        PosedBody body = posed(test_poses()[2]);
        const SidesDecision expected = decide(body.joints);
        body.joints.positions *= scale;
        for (auto& [joint, tip] : body.joints.tips) tip *= scale;
        const SidesDecision sides = decide(body.joints);
        CHECK(sides.swap_legs == expected.swap_legs);
        CHECK(sides.confidence == Approx(expected.confidence));
        CHECK((sides.frame.forward - expected.frame.forward).norm() < 1e-9);
    }
}

TEST_CASE("whoever stands straight is told with confidence; turned feet alone leave doubt") {
    CHECK(decide(posed(test_poses()[0]).joints).confidence > 0.9);
    TestPose contradictory{"one foot forward, one backward", {{"left_ankle", {0, 0, 170}}}};
    CHECK(decide(posed(contradictory).joints).confidence < 0.5);
}

TEST_CASE("head and trunk tell the sides where feet and knees say nothing") {
    RefinedJoints joints = posed(test_poses()[0]).joints;
    const auto& human = builtin_template("human21").joints;
    for (std::size_t j = 0; j < human.size(); ++j) // legs and feet straight down, arms straight
        if (human[j].role == JointRole::knee || human[j].role == JointRole::ankle || human[j].role == JointRole::foot) {
            const auto row = static_cast<Eigen::Index>(j);
            joints.positions.row(row) = joints.positions.row(human[j].parent) - Eigen::RowVector3d(0, 0, 0.3);
            for (auto& [end, tip] : joints.tips)
                if (end == static_cast<int>(j))
                    tip = joints.positions.row(row).transpose() - Vector3<double>(0, 0, 0.1);
        }
    CHECK(decide(joints).confidence < 0.2);
    const auto exchanged = relabelled(joints, [](JointRole) { return true; });
    for (const bool by_head : {false, true}) {
        RefinedJoints right = joints, wrong = exchanged;
        if (by_head) {
            right.head.emplace();
            right.head->forward = Vector3<double>::UnitY();
            right.head->frontness = 0.2;
            wrong.head = right.head;
        } else {
            right.trunk = wrong.trunk = TrunkShape{Vector3<double>::UnitY(), 0.05};
        }
        INFO((by_head ? "head" : "trunk"));
        CHECK_FALSE(decide(right).swap_legs);
        CHECK(decide(wrong).swap_legs);
        CHECK(decide(wrong).swap_arms);
        CHECK(decide(right).confidence > 0.6);
        CHECK(degrees_between(decide(right).frame.forward, Vector3<double>::UnitY()) < 5);
        CHECK(degrees_between(decide(wrong).frame.forward, Vector3<double>::UnitY()) < 5);
    }
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
    RefinedJoints no_hips = posed(test_poses()[0]).joints;
    const auto& human = builtin_template("human21").joints;
    for (std::size_t j = 0; j < human.size(); ++j)
        if (human[j].role == JointRole::hip)
            no_hips.positions.row(static_cast<Eigen::Index>(j)) = no_hips.positions.row(0);
    CHECK(error_of(no_hips) == ErrorCode::no_skeleton);

    RefinedJoints no_trunk = posed(test_poses()[0]).joints;
    for (std::size_t j = 0; j < human.size(); ++j)
        if (human[j].role == JointRole::waist)
            no_trunk.positions.row(static_cast<Eigen::Index>(j)) = middle_of_hips(no_trunk);
    CHECK(error_of(no_trunk) == ErrorCode::no_skeleton);

    RefinedJoints point = posed(test_poses()[0]).joints;
    point.positions.setZero();
    for (auto& [joint, tip] : point.tips) tip.setZero();
    CHECK(error_of(point) == ErrorCode::no_skeleton);
}

TEST_CASE("a template without ankles and end joints of the arms is told as well") {
    const SkeletonTemplate& other = builtin_template("pinocchio18");
    RefinedJoints joints;
    const auto n = static_cast<Eigen::Index>(other.joints.size());
    joints.positions.resize(n, 3);
    for (Eigen::Index j = 0; j < n; ++j) {
        const TemplateJoint& joint = other.joints[static_cast<std::size_t>(j)];
        joints.positions.row(j) = test::detail::in_space(joint.position).transpose();
        if (joint.tip) joints.tips.emplace_back(static_cast<int>(j), test::detail::in_space(*joint.tip));
    }
    const SidesDecision sides = decide_sides(joints, other);
    CHECK_FALSE(sides.swap_legs);
    CHECK_FALSE(sides.swap_arms);
    CHECK(degrees_between(sides.frame.left, -Vector3<double>::UnitX()) < 20);
}
