#include <algorithm>
#include <string>
#include <vector>

#include <skelgen/anatomy/confidence.hpp>
#include <skelgen/anatomy/impl/equal_bones.hpp>

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
    at(skeleton, "left_knee") += Vector3<Scalar>(0, Scalar(0.05), 0);
    const Vector3<Scalar> wrist = at(skeleton, "right_wrist");
    at(skeleton, "right_hand") = wrist + 3 * (at(skeleton, "right_hand") - wrist);
    return skeleton;
}

/// Of a skeleton on which nothing was made alike.
template <typename Scalar>
std::vector<double> doubts_as_they_are(const KinematicSkeleton<Scalar>& skeleton) {
    return joint_doubts(skeleton, builtin_template("human21"), bone_lengths(skeleton));
}

template <typename Scalar>
double doubt_of(const std::vector<double>& doubts, const KinematicSkeleton<Scalar>& skeleton, const char* name) {
    return doubts.at(static_cast<std::size_t>(find_joint(skeleton, name)));
}

} // namespace

TEMPLATE_TEST_CASE("joints of likely bones are not doubted, those of unlikely ones are, the worst enough to be named",
                   "", float, double) {
    for (const double doubt : doubts_as_they_are(rest_skeleton<TestType>())) CHECK(doubt < 1e-6);

    const auto wrong = with_wrong_joints<TestType>();
    const std::vector<double> doubts = doubts_as_they_are(wrong);
    const auto doubt = [&](const char* name) { return doubt_of(doubts, wrong, name); };
    CHECK(doubt("left_knee") > 0.6);
    CHECK(doubt("left_knee") < misplaced_from);
    CHECK(doubt("left_shoulder") < 1e-6);
    CHECK(doubt("neck") < 1e-6);
    std::vector<std::string> misplaced;
    for (std::size_t j = 0; j < doubts.size(); ++j)
        if (doubts[j] > misplaced_from) misplaced.push_back(wrong.joints[j].name);
    // The hand and its wrist, and against them those of the other side.
    CHECK(misplaced == std::vector<std::string>{"left_wrist", "left_hand", "right_wrist", "right_hand"});
}

TEST_CASE("a bone that is a sixth longer than the other side's, or a third than the template's, is a doubt of one") {
    // Long bones, of which the slack for short ones is a small part.
    const SkeletonTemplate& human = builtin_template("human21");
    const KinematicSkeleton<double> rest = rest_skeleton();
    std::vector<double> measured = bone_lengths(rest);
    measured[static_cast<std::size_t>(find_joint(rest, "left_knee"))] *= 7.0 / 6;
    const std::vector<double> by_side = joint_doubts(rest, human, measured);
    CHECK(doubt_of(by_side, rest, "left_knee") == Approx(1).margin(0.15));
    CHECK(doubt_of(by_side, rest, "right_knee") == Approx(doubt_of(by_side, rest, "left_knee")));
    CHECK(doubt_of(by_side, rest, "left_ankle") == 0);

    KinematicSkeleton<double> longer = rest;
    for (const std::string side : {"left_", "right_"}) {
        const Vec3 more = (at(rest, side + "knee") - at(rest, side + "hip")) / 3;
        for (const char* name : {"knee", "ankle", "foot"}) at(longer, side + name) += more;
    }
    const std::vector<double> by_template = doubts_as_they_are(longer);
    CHECK(doubt_of(by_template, longer, "left_knee") == Approx(1).margin(0.25));
    CHECK(doubt_of(by_template, longer, "left_ankle") == Approx(0).margin(1e-6));
}

TEST_CASE("the skeleton's unit does not matter, only its proportions") {
    KinematicSkeleton<double> large = with_wrong_joints<double>();
    for (Joint<double>& joint : large.joints) joint.position *= 1000;
    const std::vector<double> doubts = doubts_as_they_are(large);
    const std::vector<double> expected = doubts_as_they_are(with_wrong_joints<double>());
    for (std::size_t j = 0; j < doubts.size(); ++j) CHECK(doubts[j] == Approx(expected[j]).margin(1e-9));
}

TEST_CASE("making both sides alike does not take doubts away") {
    const KinematicSkeleton<double> uneven = with_wrong_joints<double>();
    const KinematicSkeleton<double> even = rest_skeleton<double>();
    const std::vector<double> doubts = joint_doubts(even, builtin_template("human21"), bone_lengths(uneven));
    CHECK(doubt_of(doubts, even, "left_knee") > 0.25);
    CHECK(doubt_of(doubts, even, "neck") == Approx(0).margin(1e-6));
}

TEST_CASE("where a limb leaves the trunk its first bone says nothing of the trunk's joint") {
    KinematicSkeleton<double> skeleton = rest_skeleton();
    at(skeleton, "left_shoulder") =
        at(skeleton, "chest") + 0.1 * (at(skeleton, "left_shoulder") - at(skeleton, "chest"));
    const std::vector<double> doubts = doubts_as_they_are(skeleton);
    CHECK(doubt_of(doubts, skeleton, "left_shoulder") > misplaced_from);
    CHECK(doubt_of(doubts, skeleton, "chest") < 1e-6);
}

TEST_CASE("what is missing is not doubted, and says nothing of the other side") {
    KinematicSkeleton<double> skeleton = with_wrong_joints<double>();
    Joint<double>& hand = skeleton.joints.at(static_cast<std::size_t>(find_joint(skeleton, "right_hand")));
    hand.is_present = false;
    const std::vector<double> doubts = doubts_as_they_are(skeleton);
    CHECK(std::none_of(doubts.begin(), doubts.end(), [](double doubt) { return doubt > misplaced_from; }));
    CHECK(doubt_of(doubts, skeleton, "right_hand") == 0);
    CHECK(doubt_of(doubts, skeleton, "right_wrist") == Approx(0).margin(1e-6));
    CHECK(doubt_of(doubts, skeleton, "left_hand") == Approx(0).margin(1e-6));
    const auto even = equalise_bones(skeleton, builtin_template("human21")).skeleton;
    CHECK(at(even, "left_hand") == at(skeleton, "left_hand"));
}
