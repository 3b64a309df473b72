#include <cmath>
#include <cstddef>
#include <string>
#include <type_traits>

#include <skelgen/core/builtin_templates.hpp>
#include <skelgen/embedding/proportions.hpp>
#include <skelgen/embedding/reduced_graph.hpp>

#include "catch.hpp"
#include "embedding/human_curve.hpp"

using namespace skelgen;
using namespace skelgen::embedding;
using namespace skelgen::test;

namespace {

constexpr Proportions figure{2.0, 0.6, 0.5, 1.6};

int joint_named(const SkeletonTemplate& skeleton_template, const std::string& name) {
    for (std::size_t j = 0; j < skeleton_template.joints.size(); ++j)
        if (skeleton_template.joints[j].name == name) return static_cast<int>(j);
    return -1;
}

double bone(const SkeletonTemplate& skeleton_template, const std::string& joint) {
    const int j = joint_named(skeleton_template, joint);
    return rest_length(skeleton_template, j, skeleton_template.joint(j).parent);
}

/// The bones of a template as a curve with the nodes of human_curve.
template <typename Scalar = double>
CurveSkeleton<Scalar> curve_of(const SkeletonTemplate& skeleton_template) {
    CurveSkeleton<double> curve = human_curve();
    const auto count = static_cast<Eigen::Index>(skeleton_template.joints.size());
    for (Eigen::Index j = 0; j < count; ++j)
        curve.nodes.row(j) = skeleton_template.joint(static_cast<int>(j)).position.transpose();
    Eigen::Index node = count;
    for (const TemplateJoint& joint : skeleton_template.joints) {
        if (joint.parent >= 0) {
            const auto middle = static_cast<std::size_t>(node);
            curve.nodes.row(node++) =
                0.5 * (joint.position + skeleton_template.joint(joint.parent).position).transpose();
            if (joint.radius > 0) curve.radii[middle] = joint.radius;
        }
        if (joint.tip) curve.nodes.row(node++) = joint.tip->transpose();
    }
    for (std::size_t j = 0; j < skeleton_template.joints.size(); ++j)
        if (skeleton_template.joints[j].radius > 0) curve.radii[j] = skeleton_template.joints[j].radius;
    return in_precision<Scalar>(curve);
}

} // namespace

TEST_CASE("head, arms and legs get their proportions, the trunk keeps its own") {
    const SkeletonTemplate& human = builtin_template("human21");
    const SkeletonTemplate other = with_proportions(human, figure);
    REQUIRE(other.joints.size() == human.joints.size());
    for (const char* same : {"waist", "chest", "neck", "head", "left_shoulder", "right_shoulder"})
        CHECK(bone(other, same) == Approx(bone(human, same)));
    for (const char* arm : {"left_elbow", "right_wrist", "left_hand"})
        CHECK(bone(other, arm) == Approx(figure.arms * bone(human, arm)));
    for (const char* leg : {"left_knee", "right_ankle", "left_foot"})
        CHECK(bone(other, leg) == Approx(figure.legs * bone(human, leg)));
    const auto hip = [](const SkeletonTemplate& t) { return t.joint(joint_named(t, "left_hip")).position; };
    CHECK(hip(other).x() == Approx(figure.hips * hip(human).x()));
    CHECK(hip(other).y() == Approx(hip(human).y()));
    const TemplateJoint &head = human.joint(joint_named(human, "head")),
                        &large = other.joint(joint_named(other, "head"));
    CHECK(large.radius == Approx(figure.head * head.radius));
    CHECK((*large.tip - large.position).norm() == Approx(figure.head * (*head.tip - head.position).norm()));
    const SkeletonTemplate alike = with_proportions(human, {});
    for (std::size_t j = 0; j < human.joints.size(); ++j)
        CHECK((alike.joints[j].position - human.joints[j].position).norm() < 1e-12);
}

namespace {

/// The template in the curve of its like with these proportions.
template <typename Scalar>
Embedding embedded_in(const CurveSkeleton<Scalar>& curve, const SkeletonTemplate& skeleton_template) {
    const Outcome<Embedding> found = embed(curve, skeleton_template);
    REQUIRE(found);
    return *found;
}

/// The template as it fits a curve that it can be laid into.
template <typename Scalar>
FittingTemplate fitting_in(const CurveSkeleton<Scalar>& curve, const SkeletonTemplate& skeleton_template) {
    const Outcome<FittingTemplate> found = fitting_proportions(curve, skeleton_template);
    REQUIRE(found);
    return *found;
}

/// The curve with all of a leg below its hip turned by `degrees` forwards.
CurveSkeleton<double> with_raised_leg(CurveSkeleton<double> curve, Side side, double degrees) {
    const SkeletonTemplate& human = builtin_template("human21");
    const Eigen::RowVector3d hip = human.joint(find_joint(human, JointRole::hip, side)).position.transpose();
    const double angle = degrees * 3.14159265358979 / 180;
    for (Eigen::Index v = 0; v < curve.nodes.rows(); ++v) {
        const Eigen::RowVector3d below = curve.nodes.row(v) - hip;
        if (below.y() >= 0 || (curve.nodes(v, 0) > 0) != (hip.x() > 0) || curve.nodes(v, 1) > 0.87) continue;
        curve.nodes.row(v) =
            hip + Eigen::RowVector3d(below.x(), std::cos(angle) * below.y() + std::sin(angle) * below.z(),
                                     std::cos(angle) * below.z() - std::sin(angle) * below.y());
    }
    return curve;
}

} // namespace

TEMPLATE_TEST_CASE("proportions are read off a curve, as far as figures have them", "", float, double) {
    const SkeletonTemplate& human = builtin_template("human21");
    const double within = std::is_same_v<TestType, float> ? 1e-4 : 1e-9;
    for (const Proportions& proportions :
         {Proportions{}, Proportions{1.7, 0.7, 0.6, 1}, Proportions{0.8, 1.1, 0.4, 1}}) {
        const SkeletonTemplate other = with_proportions(human, proportions);
        const auto curve = curve_of<TestType>(other);
        const Proportions found = proportions_of(curve, embedded_in(curve, other), human);
        CHECK(found.head == Approx(proportions.head).margin(within));
        CHECK(found.arms == Approx(proportions.arms).margin(within));
        CHECK(found.legs == Approx(proportions.legs).margin(within));
        CHECK(found.hips == 1);
    }
    const SkeletonTemplate gnome = with_proportions(human, {4, 0.1, 0.1, 1});
    const auto curve = curve_of<TestType>(gnome);
    const Proportions found = proportions_of(curve, embedded_in(curve, gnome), human);
    CHECK(found.head == 2.5);
    CHECK(found.arms == 0.3);
    CHECK(found.legs == 0.25);
}

TEST_CASE("legs go on from the trunk where a body stands, not where one is raised or both are") {
    const SkeletonTemplate& human = builtin_template("human21");
    const CurveSkeleton<double> standing = curve_of(human);
    const Embedding embedding = embedded_in(standing, human);
    CHECK(legs_go_on(standing, embedding, human));
    CHECK(legs_go_on(with_raised_leg(standing, Side::left, 30), embedding, human));
    CHECK_FALSE(legs_go_on(with_raised_leg(standing, Side::left, 80), embedding, human));
    CHECK_FALSE(legs_go_on(with_raised_leg(standing, Side::right, 80), embedding, human));
    const auto seated = with_raised_leg(with_raised_leg(standing, Side::left, 85), Side::right, 85);
    CHECK_FALSE(legs_go_on(seated, embedding, human));

    const SkeletonTemplate legless = without_limb(human, joint_named(human, "left_knee"));
    CHECK_FALSE(legs_go_on(standing, embedded_in(standing, legless), legless));
}

TEST_CASE("a figure that stands gets its own proportions, one on four feet does not") {
    const SkeletonTemplate& human = builtin_template("human21");
    constexpr Proportions long_arms{0.7, 1.15, 0.3, 1}; // between none of the built-in ones
    const CurveSkeleton<double> standing = curve_of(with_proportions(human, long_arms));
    const FittingTemplate fitting = fitting_in(standing, human);
    REQUIRE(fitting.is_odd);
    CHECK(fitting.skeleton_template.is_adapted);
    CHECK(bone(fitting.skeleton_template, "left_knee") ==
          Approx(long_arms.legs * bone(human, "left_knee")).epsilon(0.05));
    CHECK(bone(fitting.skeleton_template, "left_elbow") ==
          Approx(long_arms.arms * bone(human, "left_elbow")).epsilon(0.05));

    const auto crawling = with_raised_leg(with_raised_leg(standing, Side::left, 85), Side::right, 85);
    CHECK_FALSE(fitting_in(crawling, human).is_odd);
}

TEMPLATE_TEST_CASE("an adult's curve keeps the adult's template", "", float, double) {
    const SkeletonTemplate& human = builtin_template("human21");
    const FittingTemplate fitting = fitting_in(curve_of<TestType>(human), human);
    CHECK_FALSE(fitting.is_odd);
    CHECK(bone(fitting.skeleton_template, "left_knee") == bone(human, "left_knee"));
    CHECK_FALSE(fitting.skeleton_template.is_adapted);
}

TEMPLATE_TEST_CASE("a figure's curve gets a figure's template", "", float, double) {
    const SkeletonTemplate& human = builtin_template("human21");
    const FittingTemplate fitting = fitting_in(curve_of<TestType>(with_proportions(human, figure)), human);
    CHECK(fitting.is_odd);
    CHECK(bone(fitting.skeleton_template, "left_knee") == Approx(figure.legs * bone(human, "left_knee")));
}

TEST_CASE("what no proportions explain keeps the given template") {
    const SkeletonTemplate& human = builtin_template("human21");
    CurveSkeleton<double> lopsided = curve_of(human);
    for (const char* joint : {"left_wrist", "left_hand", "right_ankle", "right_foot"}) {
        const int j = joint_named(human, joint), parent = human.joint(j).parent;
        lopsided.nodes.row(j) = lopsided.nodes.row(parent); // one arm and the other leg end early
    }
    const FittingTemplate fitting = fitting_in(lopsided, human);
    CHECK_FALSE(fitting.is_odd);
    CHECK(bone(fitting.skeleton_template, "left_knee") == bone(human, "left_knee"));
}

TEST_CASE("a template that lacks a limb stays as it is") {
    const SkeletonTemplate& human = builtin_template("human21");
    const SkeletonTemplate armless = without_limb(human, joint_named(human, "left_elbow"));
    const FittingTemplate fitting = fitting_in(curve_of(with_proportions(human, figure)), armless);
    CHECK_FALSE(fitting.is_odd);
    CHECK(bone(fitting.skeleton_template, "left_knee") == bone(human, "left_knee"));
}
