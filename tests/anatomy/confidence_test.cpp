#include <algorithm>

#include <skelgen/anatomy/confidence.hpp>
#include <skelgen/anatomy/equal_bones.hpp>

#include "anatomy/rest_skeleton.hpp"
#include "catch.hpp"

using namespace skelgen;
using namespace skelgen::anatomy;
using namespace skelgen::test;

namespace {

/// The rest pose with a knee a little too high and a hand that is three times as long.
template <typename Scalar>
KinematicSkeleton<Scalar> with_wrong_joints() {
    KinematicSkeleton<Scalar> skeleton = rest_skeleton<Scalar>();
    skeleton.quality.sides_confidence = 1;
    at(skeleton, "left_knee") += Vector3<Scalar>(0, Scalar(0.05), 0);
    const Vector3<Scalar> wrist = at(skeleton, "right_wrist");
    at(skeleton, "right_hand") = wrist + 3 * (at(skeleton, "right_hand") - wrist);
    return skeleton;
}

/// Of a skeleton on which nothing was made alike.
template <typename Scalar>
JudgedSkeleton<Scalar> judged_as_they_are(const KinematicSkeleton<Scalar>& skeleton,
                                          const std::vector<int>& moved = {}) {
    return estimate_confidence(skeleton, builtin_template("human21"), bone_lengths(skeleton), moved);
}

} // namespace

TEMPLATE_TEST_CASE("joints of likely bones are trusted, those of unlikely ones are not, and the worst are named", "",
                   float, double) {
    KinematicSkeleton<TestType> likely = rest_skeleton<TestType>();
    likely.quality.sides_confidence = 1;
    const auto trusted = judged_as_they_are(likely);
    CHECK(trusted.misplaced == 0);
    CHECK(trusted.skeleton.quality.sides_confidence == 1);
    for (const Joint<TestType>& joint : trusted.skeleton.joints) CHECK(joint.confidence == Approx(1));
    CHECK(trusted.skeleton.quality.warnings.empty());

    const auto judged = judged_as_they_are(with_wrong_joints<TestType>());
    const auto confidence = [&](const char* name) { return joint_named(judged.skeleton, name).confidence; };
    CHECK(judged.misplaced == 4); // the hand and its wrist, and against them those of the other side
    CHECK(judged.skeleton.quality.sides_confidence == Approx(0.75)); // a misplaced hand may be the other one
    CHECK(confidence("left_knee") < 0.6);
    CHECK(confidence("right_hand") < 0.1);
    CHECK(confidence("right_wrist") < 0.1);
    CHECK(confidence("left_shoulder") == Approx(1));
    CHECK(confidence("neck") == Approx(1));
    std::string all;
    for (const std::string& warning : judged.skeleton.quality.warnings) all += warning + '\n';
    CHECK(all.find("joint right_hand may be misplaced: its bones have unlikely lengths") != std::string::npos);
    CHECK(all.find("left_shoulder") == std::string::npos);
}

TEST_CASE("joints that were moved inside are half as sure, and no more misplaced for that") {
    const auto plain = judged_as_they_are(with_wrong_joints<double>());
    const std::vector<int> moved{find_joint(plain.skeleton, "waist"), find_joint(plain.skeleton, "left_ankle")};
    const auto judged = judged_as_they_are(with_wrong_joints<double>(), moved);
    CHECK(judged.misplaced == plain.misplaced);
    CHECK(judged.skeleton.quality.warnings == plain.skeleton.quality.warnings);
    for (std::size_t j = 0; j < judged.skeleton.joints.size(); ++j) {
        const bool was_moved = std::find(moved.begin(), moved.end(), static_cast<int>(j)) != moved.end();
        CHECK(judged.skeleton.joints[j].confidence ==
              Approx(plain.skeleton.joints[j].confidence * (was_moved ? 0.5 : 1)));
    }
}

TEST_CASE("the skeleton's unit does not matter, only its proportions") {
    KinematicSkeleton<double> large = with_wrong_joints<double>();
    for (Joint<double>& joint : large.joints) joint.position *= 1000;
    const auto judged = judged_as_they_are(large);
    const auto expected = judged_as_they_are(with_wrong_joints<double>());
    for (std::size_t j = 0; j < large.joints.size(); ++j)
        CHECK(judged.skeleton.joints[j].confidence == Approx(expected.skeleton.joints[j].confidence));
}

TEST_CASE("making both sides alike does not make them more certain") {
    const KinematicSkeleton<double> uneven = with_wrong_joints<double>();
    const KinematicSkeleton<double> even = rest_skeleton<double>();
    const auto judged = estimate_confidence(even, builtin_template("human21"), bone_lengths(uneven), {});
    CHECK(joint_named(judged.skeleton, "left_knee").confidence < 0.8);
    CHECK(joint_named(judged.skeleton, "neck").confidence == Approx(1));
}

TEST_CASE("what is missing is neither trusted nor misplaced, and says nothing of the other side") {
    KinematicSkeleton<double> skeleton = with_wrong_joints<double>();
    Joint<double>& hand = skeleton.joints.at(static_cast<std::size_t>(find_joint(skeleton, "right_hand")));
    hand.is_present = false;
    hand.confidence = 0;
    const auto judged = judged_as_they_are(skeleton);
    CHECK(judged.misplaced == 0);
    CHECK(joint_named(judged.skeleton, "right_hand").confidence == 0);
    CHECK(joint_named(judged.skeleton, "right_wrist").confidence == Approx(1));
    CHECK(joint_named(judged.skeleton, "left_hand").confidence == Approx(1));
    const auto even = equalise_bones(skeleton, builtin_template("human21")).skeleton;
    CHECK(at(even, "left_hand") == at(skeleton, "left_hand"));
}

TEST_CASE("no joint is surer than the sides, nor than the joints are on average") {
    KinematicSkeleton<double> skeleton = rest_skeleton<double>();
    for (Joint<double>& joint : skeleton.joints) joint.confidence = 0.8;
    skeleton.joints[0].confidence = 1;
    skeleton.joints[1].confidence = 0.6;
    skeleton.joints[2].confidence = 0;
    skeleton.joints[2].is_present = false;
    skeleton.quality.sides_confidence = 0.9;
    const auto by_mean = no_surer_than_the_whole(skeleton);
    CHECK(by_mean.joints[0].confidence == Approx(0.8));
    CHECK(by_mean.joints[1].confidence == 0.6);
    CHECK(by_mean.joints[2].confidence == 0);
    skeleton.quality.sides_confidence = 0.3;
    const auto by_sides = no_surer_than_the_whole(skeleton);
    CHECK(by_sides.joints[0].confidence == 0.3);
    CHECK(by_sides.joints[1].confidence == 0.3);
    CHECK(by_sides.quality.sides_confidence == 0.3);
}

TEST_CASE("where most joints are unlikely, the sides are not sure either") {
    KinematicSkeleton<double> skeleton = rest_skeleton<double>();
    for (Joint<double>& joint : skeleton.joints) joint.confidence = 0.2;
    skeleton.quality.sides_confidence = 0.9;
    CHECK(no_surer_than_the_whole(skeleton).quality.sides_confidence == Approx(0.9 * 0.2 / 0.55));
    for (Joint<double>& joint : skeleton.joints) joint.confidence = 0.6;
    CHECK(no_surer_than_the_whole(skeleton).quality.sides_confidence == 0.9);
}
