#include <cstddef>
#include <string>

#include <skelgen/core/builtin_templates.hpp>
#include <skelgen/embedding/proportions.hpp>

#include "catch.hpp"

using namespace skelgen;
using namespace skelgen::embedding;

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
