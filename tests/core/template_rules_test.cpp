#include "catch.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <string>

#include <skelgen/core/builtin_templates.hpp>
#include <skelgen/core/error.hpp>
#include <skelgen/core/template_rules.hpp>

namespace {

using namespace skelgen;

TemplateJoint& joint(SkeletonTemplate& t, const std::string& name) {
    const auto found =
        std::find_if(t.joints.begin(), t.joints.end(), [&](const TemplateJoint& j) { return j.name == name; });
    REQUIRE(found != t.joints.end());
    return *found;
}

/// The message with which human21, changed by `edit`, is refused; empty when it is not.
std::string refusal(const std::function<void(SkeletonTemplate&)>& edit) {
    SkeletonTemplate t = builtin_template("human21");
    edit(t);
    try {
        validate_template(t);
    } catch (const Error& error) {
        CHECK(error.code() == ErrorCode::bad_input);
        return error.what();
    }
    return {};
}

/// Takes out a joint; its children hang on its parent.
void remove_joint(SkeletonTemplate& t, const std::string& name) {
    const auto index = static_cast<int>(&joint(t, name) - t.joints.data());
    const int parent = t.joints[static_cast<std::size_t>(index)].parent;
    t.joints.erase(t.joints.begin() + index);
    for (TemplateJoint& each : t.joints) {
        if (each.parent == index) each.parent = parent;
        if (each.parent > index) --each.parent;
    }
}

} // namespace

TEST_CASE("a template unchanged is accepted") {
    CHECK(refusal([](SkeletonTemplate&) {}).empty());
}

TEST_CASE("joints that a template may lack") {
    for (const std::string name : {"waist", "neck"}) CHECK(refusal([&](auto& t) { remove_joint(t, name); }).empty());
    for (const std::string name : {"shoulder", "elbow", "wrist", "ankle"})
        CHECK(refusal([&](auto& t) {
                  remove_joint(t, "left_" + name);
                  remove_joint(t, "right_" + name);
              }).empty());
}

TEST_CASE("joints that a template must have") {
    for (const std::string name : {"head", "left_hand", "right_hand", "left_foot", "right_foot"})
        CHECK(refusal([&](auto& t) { remove_joint(t, name); }).find("there is no ") == 0);
    for (const std::string name : {"hip", "knee"})
        CHECK(refusal([&](auto& t) {
                  remove_joint(t, "left_" + name);
                  remove_joint(t, "right_" + name);
              }) == "there is no left " + name + ": add one");
    CHECK(refusal([](auto& t) { remove_joint(t, "left_elbow"); }) ==
          "joint 'right_elbow' has no counterpart: add a left elbow");
}

TEST_CASE("a second neck is accepted, a second chest is not") {
    CHECK(refusal([](auto& t) {
              TemplateJoint second = joint(t, "neck");
              second.name = "lower_neck";
              second.position.y() -= 0.05;
              const auto place = t.joints.begin() + (&joint(t, "neck") - t.joints.data());
              const int index = static_cast<int>(place - t.joints.begin());
              t.joints.insert(place, second);
              for (TemplateJoint& each : t.joints)
                  if (each.parent >= index) ++each.parent;
              joint(t, "neck").parent = index;
          }).empty());
    CHECK(refusal([](auto& t) { joint(t, "neck").role = JointRole::chest; }) ==
          "joints 'chest' and 'neck' are both the chest: there must be one");
}

TEST_CASE("values that make no sense are refused") {
    CHECK(refusal([](auto& t) { t.name.clear(); }).find("has no name") != std::string::npos);
    CHECK(refusal([](auto& t) { t.joints.clear(); }).find("no joints") != std::string::npos);
    CHECK(refusal([](auto& t) { joint(t, "neck").name.clear(); }).find("empty name") != std::string::npos);
    CHECK(refusal([](auto& t) { joint(t, "neck").name = "head"; }) == "two joints are named 'head'");
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
        CHECK(refusal([&](auto& t) { joint(t, "left_knee").position.y() = bad; }) ==
              "joint 'left_knee' has a position that is not finite");
    CHECK(refusal([](auto& t) { joint(t, "neck").side = Side::left; }).find("must be none") != std::string::npos);
    CHECK(refusal([](auto& t) { joint(t, "left_hip").side = Side::none; }).find("left or right") != std::string::npos);
    CHECK(refusal([](auto& t) { joint(t, "neck").position = joint(t, "chest").position; }) ==
          "joint 'neck' lies where its parent 'chest' lies: a bone needs a length");
}

TEST_CASE("tips are for the ends of branches") {
    CHECK(refusal([](auto& t) { joint(t, "head").tip.reset(); }).empty());
    CHECK(refusal([](auto& t) { joint(t, "neck").tip = Vector3<double>(0, 2, 0); }) ==
          "joint 'neck' has a tip: only the head, hands and feet may");
    CHECK(refusal([](auto& t) { joint(t, "head").tip->x() = std::numeric_limits<double>::quiet_NaN(); }) ==
          "joint 'head' has a tip that is not finite");
    CHECK(refusal([](auto& t) { joint(t, "head").tip = joint(t, "head").position; }).find("its own place") !=
          std::string::npos);
}

TEST_CASE("joints that are no tree are refused") {
    CHECK(refusal([](auto& t) { joint(t, "neck").parent = -1; }) ==
          "joint 'neck' has no parent: only the first joint, the root, may have none");
    CHECK(refusal([](auto& t) { joint(t, "crotch").parent = 1; }).find("the first joint is the root") !=
          std::string::npos);
    CHECK(refusal([](auto& t) { joint(t, "neck").parent = 4; }).find("parents before children") != std::string::npos);
    CHECK(refusal([](auto& t) { joint(t, "neck").parent = 99; }).find("parents before children") != std::string::npos);
    CHECK(refusal([](auto& t) { std::swap(t.joints[0], t.joints[1]); }).find("root") != std::string::npos);
}

TEST_CASE("joints in an impossible order are refused") {
    CHECK(refusal([](auto& t) { joint(t, "left_shoulder").parent = 0; }) ==
          "joint 'left_shoulder', a left shoulder, cannot hang on 'crotch', a pelvis");
    CHECK(refusal([](auto& t) { joint(t, "left_hip").parent = 2; }).find("cannot hang on 'chest'") !=
          std::string::npos);
    CHECK(refusal([](auto& t) {
              std::swap(joint(t, "left_elbow").role, joint(t, "left_wrist").role);
          }).find("cannot hang on") != std::string::npos);
    CHECK(refusal([](auto& t) {
              joint(t, "left_hand").parent = static_cast<int>(&joint(t, "left_elbow") - t.joints.data());
          }) == "joint 'left_wrist' ends a branch: only the head, hands and feet may");
}

TEST_CASE("a template whose left is on its right is refused") {
    const std::string what = refusal([](auto& t) {
        for (TemplateJoint& each : t.joints) each.position.x() *= -1;
    });
    CHECK(what.find("x must grow towards the person's own left") != std::string::npos);
    CHECK(refusal([](auto& t) { std::swap(joint(t, "left_elbow").side, joint(t, "right_elbow").side); }) ==
          "joint 'right_elbow' is not to the left of 'left_elbow': x must grow towards the person's own left");
}

TEST_CASE("a template that lies down, as one with z up does, is refused") {
    const std::string what = refusal([](auto& t) {
        for (TemplateJoint& each : t.joints) std::swap(each.position.y(), each.position.z());
    });
    CHECK(what == "joint 'neck' is not above 'left_hip': y must grow from the hips to the head");
}

TEST_CASE("joints are found by role and side, and by their counterpart") {
    const SkeletonTemplate& t = builtin_template("human21");
    const int left = find_joint(t, JointRole::knee, Side::left), right = find_joint(t, JointRole::knee, Side::right);
    CHECK(t.joint(left).name == "left_knee");
    CHECK(counterpart(t, left) == right);
    CHECK(counterpart(t, right) == left);
    CHECK(counterpart(t, 0) == -1);
    CHECK(find_joint(t, JointRole::knee) == -1);
    CHECK(rest_length(t, left, find_joint(t, JointRole::hip, Side::left)) == Approx(0.389));
    CHECK(part_of(JointRole::head) == BodyPart::trunk);
    CHECK(part_of(JointRole::hand) == BodyPart::arm);
    CHECK(part_of(JointRole::hip) == BodyPart::leg);
}

TEST_CASE("roles and sides spell themselves") {
    CHECK(to_string(JointRole::pelvis) == "pelvis");
    CHECK(to_string(JointRole::foot) == "foot");
    CHECK(to_string(Side::left) == "left");
    CHECK_THROWS_AS(to_string(static_cast<JointRole>(99)), Error);
    CHECK_THROWS_AS(to_string(static_cast<Side>(99)), Error);
}
