#include <skelgen/core/error.hpp>
#include <skelgen/synth/body.hpp>

#include "catch.hpp"

using namespace skelgen;
using namespace skelgen::synth;

TEST_CASE("named poses are within human limits, and an average body holds them without touching itself") {
    for (const std::string& name : pose_names()) {
        INFO(name);
        CHECK_NOTHROW(check_pose(named_pose(name)));
        CHECK(limb_clearance({}, spread_limbs({}, named_pose(name))) > 0.003);
    }
}

TEST_CASE("mirroring twice gives the pose back") {
    const BodyPose pose = random_pose(3), twice = mirrored(mirrored(pose));
    for (std::size_t j = 0; j < pose.angles.size(); ++j) {
        CHECK(pose.angles[j].bend == twice.angles[j].bend);
        CHECK(pose.angles[j].side == twice.angles[j].side);
        CHECK(pose.angles[j].turn == twice.angles[j].turn);
    }
    CHECK(mirrored(pose).at(BodyJoint::left_knee).bend == pose.at(BodyJoint::right_knee).bend);
}

TEST_CASE("random poses stay within the limits, differ from seed to seed and keep the limbs apart") {
    for (unsigned seed = 0; seed < 20; ++seed) {
        CHECK_NOTHROW(check_pose(random_pose(seed)));
        CHECK(random_pose(seed).at(BodyJoint::left_hip).bend != random_pose(seed + 1).at(BodyJoint::left_hip).bend);
        CHECK(limb_clearance({}, random_free_pose({}, seed)) > 0.003);
    }
}

TEST_CASE("a pose file starts from a named pose and sets joints by name") {
    const BodyPose pose = parse_pose(R"({"left_elbow": [90, 1, 0], "pose": "t"})");
    CHECK(pose.at(BodyJoint::left_elbow).bend == 90);
    CHECK(pose.at(BodyJoint::left_elbow).side == 1);
    CHECK(pose.at(BodyJoint::right_shoulder).side == named_pose("t").at(BodyJoint::right_shoulder).side);
}

TEST_CASE("what is no pose is refused") {
    for (const char* text : {"", "[]", "{", R"({"left_elbow": 90})", R"({"left_elbow": ["a", 0, 0]})",
                             R"({"tail": [0, 0, 0]})", R"({"pose": 3})"}) {
        INFO(text);
        try {
            (void)parse_pose(text);
            FAIL("accepted");
        } catch (const Error& error) {
            CHECK(error.code() == ErrorCode::bad_input);
        }
    }
}
