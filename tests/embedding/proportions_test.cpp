#include <cstddef>
#include <string>

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

TEMPLATE_TEST_CASE("an adult's curve keeps the adult's template", "", float, double) {
    const SkeletonTemplate& human = builtin_template("human21");
    const FittingTemplate fitting = fitting_proportions(curve_of<TestType>(human), human);
    CHECK_FALSE(fitting.is_odd);
    CHECK_FALSE(fitting.fits_badly);
    CHECK(bone(fitting.skeleton_template, "left_knee") == bone(human, "left_knee"));
}

TEMPLATE_TEST_CASE("a figure's curve gets a figure's template", "", float, double) {
    const SkeletonTemplate& human = builtin_template("human21");
    const FittingTemplate fitting = fitting_proportions(curve_of<TestType>(with_proportions(human, figure)), human);
    CHECK(fitting.is_odd);
    CHECK_FALSE(fitting.fits_badly);
    CHECK(bone(fitting.skeleton_template, "left_knee") == Approx(figure.legs * bone(human, "left_knee")));
}

TEST_CASE("what no proportions explain is said to fit badly, and keeps the given template") {
    const SkeletonTemplate& human = builtin_template("human21");
    CurveSkeleton<double> lopsided = curve_of(human);
    for (const char* joint : {"left_wrist", "left_hand", "right_ankle", "right_foot"}) {
        const int j = joint_named(human, joint), parent = human.joint(j).parent;
        lopsided.nodes.row(j) = lopsided.nodes.row(parent); // one arm and the other leg end early
    }
    const FittingTemplate fitting = fitting_proportions(lopsided, human);
    CHECK(fitting.fits_badly);
    CHECK_FALSE(fitting.is_odd);
    CHECK(bone(fitting.skeleton_template, "left_knee") == bone(human, "left_knee"));
}

TEST_CASE("a template that lacks a limb stays as it is") {
    const SkeletonTemplate& human = builtin_template("human21");
    const SkeletonTemplate armless = without_limb(human, joint_named(human, "left_elbow"));
    const FittingTemplate fitting = fitting_proportions(curve_of(with_proportions(human, figure)), armless);
    CHECK_FALSE(fitting.is_odd);
    CHECK_FALSE(fitting.fits_badly);
    CHECK(bone(fitting.skeleton_template, "left_knee") == bone(human, "left_knee"));
}
