#include <skelgen/applications/finger_bones.hpp>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include <skelgen/core/builtin_templates.hpp>
#include <skelgen/core/error.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/hands/find_hands.hpp>
#include <skelgen/io/rig_formats.hpp>

#include "catch.hpp"
#include "sample_body.hpp"

namespace {

using namespace skelgen;
using namespace skelgen::applications;
using namespace skelgen::test;
using Vec3 = Vector3<double>;

/// The sample, whose hands have all digits.
const Rig<double>& rig_with_fingers() {
    static const Rig<double> rig = [] {
        const SampleBody& sample = sample_body();
        const SkeletonTemplate& human = builtin_template("human21");
        return with_finger_bones(make_rig(sample.mesh, sample.body, sample.skeleton, human, RestPose::t_pose),
                                 sample.mesh, sample.skeleton, human,
                                 hands::find_hands(sample.mesh, sample.body, sample.skeleton));
    }();
    return rig;
}

std::size_t joint_named(const Rig<double>& rig, const std::string& name) {
    for (std::size_t j = 0; j < rig.joints.size(); ++j)
        if (rig.joints[j].name == name) return j;
    FAIL("there is no joint " << name);
    return 0;
}

/// The digit that a joint is of, such as left_index; empty for another joint.
std::string digit_of(const std::string& name) {
    if (!hands::digit_joint(split_side(name).plain)) return "";
    return name.substr(0, name.size() - 2);
}

/// Motions of all joints where those of a digit turn about x by an angle each.
std::vector<RigidMotion<double>> bent(const Rig<double>& rig, const std::string& digit, double angle) {
    std::vector<RigidMotion<double>> motions;
    for (const RigJoint<double>& joint : rig.joints) {
        RigidMotion<double> motion =
            joint.parent < 0 ? RigidMotion<double>{} : motions[static_cast<std::size_t>(joint.parent)];
        if (digit_of(joint.name) == digit) {
            const Eigen::Quaterniond turn(Eigen::AngleAxisd(angle, joint.axes * Vec3::UnitX()));
            const Vec3 pivot = motion(joint.position);
            motion.rotation = (motion.rotation * turn).normalized();
            motion.translation = pivot - motion.rotation * joint.position;
        }
        motions.push_back(motion);
    }
    return motions;
}

} // namespace

TEST_CASE("a rig with fingers has three bones a digit below the wrist", "[applications][hands]") {
    const Rig<double>& rig = rig_with_fingers();
    REQUIRE(rig.joints.size() == 21 + 30);
    for (const Side side : {Side::left, Side::right})
        for (const hands::Digit digit : hands::all_digits) {
            std::string parent = std::string(side_prefix(side)) + "wrist";
            for (std::size_t k = 1; k <= hands::phalanges; ++k) {
                const RigJoint<double>& joint = rig.joints[joint_named(rig, hands::joint_name(side, digit, k))];
                INFO(joint.name);
                CHECK(rig.joints.at(static_cast<std::size_t>(joint.parent)).name == parent);
                CHECK((joint.axes * Vec3::UnitY()).dot((joint.end - joint.position).normalized()) > 1 - 1e-9);
                CHECK(core::winding_number(rig.mesh, joint.position) > 0.5);
                parent = joint.name;
            }
        }
}

TEST_CASE("no vertex follows two digits, and what is in the middle of the knuckles moves none",
          "[applications][hands]") {
    const Rig<double>& rig = rig_with_fingers();
    int followers = 0;
    for (Eigen::Index v = 0; v < rig.skin.joints.rows(); ++v) {
        std::set<std::string> digits;
        double sum = 0;
        for (int k = 0; k < Skin<double>::influences; ++k) {
            const double weight = rig.skin.weights(v, k);
            CHECK(weight >= 0);
            if (k > 0) CHECK(weight <= rig.skin.weights(v, k - 1));
            sum += weight;
            if (!(weight > 0)) continue;
            const std::string& name = rig.joints[static_cast<std::size_t>(rig.skin.joints(v, k))].name;
            CHECK_FALSE((name == "left_hand" || name == "right_hand"));
            if (const std::string digit = digit_of(name); !digit.empty()) digits.insert(digit);
        }
        CHECK(sum == Approx(1).margin(1e-12));
        CHECK(digits.size() <= 1);
        followers += digits.empty() ? 0 : 1;
    }
    CHECK(followers > 100);
}

TEST_CASE("a digit that bends comes to the palm, leaves the others where they are, and keeps its volume",
          "[applications][hands]") {
    const Rig<double>& rig = rig_with_fingers();
    const double volume = core::enclosed_volume(rig.mesh);
    for (const Side side : {Side::left, Side::right})
        for (const hands::Digit digit : hands::all_digits) {
            const std::string name = std::string(side_prefix(side)).append(hands::name_of(digit));
            INFO(name);
            const auto motions = bent(rig, name, 0.8);
            const auto moved = skinned_linearly(rig.mesh.vertices, rig.skin, motions);
            const std::size_t last = joint_named(rig, name + "_3");
            const std::size_t wrist = joint_named(rig, std::string(side_prefix(side)) + "wrist");
            const Vec3 tip = rig.joints[last].end, now = motions[last](tip);
            CHECK((now - rig.joints[wrist].position).norm() < (tip - rig.joints[wrist].position).norm());
            if (digit != hands::Digit::thumb) CHECK((now - tip).normalized().y() < 0); // palms are down in the T-pose

            double others = 0, own = 0;
            for (Eigen::Index v = 0; v < moved.rows(); ++v) {
                const double way = (moved.row(v) - rig.mesh.vertices.row(v)).norm();
                const std::string strongest =
                    digit_of(rig.joints[static_cast<std::size_t>(rig.skin.joints(v, 0))].name);
                if (strongest == name) own = std::max(own, way);
                if (!strongest.empty() && strongest != name) others = std::max(others, way);
            }
            CHECK(own > (tip - rig.joints[joint_named(rig, name + "_1")].position).norm() / 2);
            CHECK(others < 1e-9);

            // A digit's volume is about a girth times its length; a thumb's has the ball of it, too.
            const double length = (tip - rig.joints[joint_named(rig, name + "_1")].position).norm();
            const double thickness = digit == hands::Digit::thumb ? 0.016 : 0.009; // of the sample's, in metres
            const double lost = std::abs(core::enclosed_volume(TriangleMesh<double>{moved, rig.mesh.faces}) - volume);
            CHECK(lost < 0.15 * std::acos(-1.0) * thickness * thickness * length);
        }
}

TEST_CASE("bones of fingers have the names of each convention", "[applications][hands]") {
    const Rig<double>& rig = rig_with_fingers();
    const auto names = [&](io::JointNames convention) {
        const auto all = io::names_of(rig.joints, convention);
        const std::set<std::string> set(all.begin(), all.end());
        CHECK(set.size() == all.size());
        return set;
    };
    // Of Mixamo's rigs, of VRM 1.0's humanoid bones (VRMC_vrm-1.0/humanoid.md) and of SMPL-X.
    for (const char* name :
         {"LeftHandThumb1", "LeftHandThumb3", "LeftHandIndex1", "RightHandMiddle1", "RightHandRing2", "LeftHandPinky3"})
        CHECK(names(io::JointNames::mixamo).contains(name));
    for (const char* side : {"left", "right"}) {
        for (const char* part : {"ThumbMetacarpal", "ThumbProximal", "ThumbDistal"})
            CHECK(names(io::JointNames::vrm).contains(std::string(side) + part));
        for (const char* digit : {"Index", "Middle", "Ring", "Little"})
            for (const char* part : {"Proximal", "Intermediate", "Distal"})
                CHECK(names(io::JointNames::vrm).contains(std::string(side) + digit + part));
    }
    for (const char* name : {"left_thumb1", "left_index1", "right_pinky3"})
        CHECK(names(io::JointNames::smpl).contains(name));
}

TEST_CASE("fingers go to the rig of their skeleton alone", "[applications][hands]") {
    Rig<double> rig = rig_with_fingers(); // which has them already
    const SampleBody& sample = sample_body();
    CHECK_THROWS_AS(with_finger_bones(rig, sample.mesh, sample.skeleton, builtin_template("human21"), {}), Error);
}
