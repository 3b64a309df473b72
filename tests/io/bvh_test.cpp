#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <skelgen/core/error.hpp>
#include <skelgen/io/bvh.hpp>

#include "catch.hpp"
#include "temporary_folder.hpp"
#include "walking_clip.hpp"

namespace {

using namespace skelgen;
using applications::ClipChannel;
using applications::MotionClip;

const std::string arm = R"(HIERARCHY
ROOT Upper Arm
{
    OFFSET 1 2 3
    CHANNELS 6 Yrotation Xposition Zposition Yposition Xrotation Zrotation
    JOINT Forearm
    {
        OFFSET 10 0 0
        CHANNELS 1 Zrotation
        End Site
        {
            OFFSET 5 0 0
        }
    }
}
MOTION
Frames: 2
Frame Time: 0.04
0 1 3 2 0 0 0
90 0 0 0 0 90 90
)";

TEST_CASE("BVH: hierarchy, channels in any order, frames", "[io][bvh]") {
    const MotionClip clip = io::parse_bvh(arm);
    REQUIRE(clip.joints.size() == 2);
    CHECK(clip.joints[0].name == "Upper Arm");
    CHECK(clip.joints[0].channels.front() == ClipChannel::y_rotation);
    CHECK(clip.joints[1].parent == 0);
    REQUIRE(clip.joints[1].end);
    CHECK(*clip.joints[1].end == Eigen::Vector3d(5, 0, 0));
    CHECK(clip.seconds_per_frame == 0.04);
    REQUIRE(clip.frames.rows() == 2);

    CHECK(pose_in(clip, 0).positions[1] == Eigen::Vector3d(11, 2, 3));
    CHECK(rest_pose(clip).positions[1] == Eigen::Vector3d(11, 2, 3));
    // The second frame: z turns by 90 degrees, then x by none, then y by 90: (10, 0, 0) -> (0, 10, 0) -> itself. The
    // forearm bends by 90 degrees within that.
    const auto pose = pose_in(clip, 1);
    CHECK((pose.positions[1] - Eigen::Vector3d(0, 10, 0)).norm() < 1e-12);
    CHECK((pose.turns[1] * Eigen::Vector3d(5, 0, 0) - Eigen::Vector3d(0, 0, 5)).norm() < 1e-12);
    CHECK_THROWS_WITH(pose_in(clip, 2), Catch::Matchers::Contains("frame 2"));
    MotionClip short_of_numbers = clip;
    short_of_numbers.frames.conservativeResize(Eigen::NoChange, 6);
    CHECK_THROWS_AS(pose_in(short_of_numbers, 0), Error);
}

TEST_CASE("BVH: as programs write it", "[io][bvh]") {
    std::string text = "\xEF\xBB\xBF";
    for (const char c : arm) text += c == '\n' ? std::string("\r\n") : std::string(1, c);
    const auto replace = [&](const std::string& from, const std::string& to) {
        const auto at = text.find(from);
        REQUIRE(at != std::string::npos);
        text.replace(at, from.size(), to);
    };
    replace("ROOT Upper Arm\r\n{", "Root  Upper\tArm{");
    replace("End Site", "END SITE");
    replace("Frames: 2", "frames :2");
    replace("Frame Time:", "FRAME TIME:");
    replace("Zrotation", "ZROTATION");
    replace("0 1 3 2 0 0 0", "0 1 3\r\n2 0 +0 0.0e1");
    const MotionClip clip = io::parse_bvh(text);
    CHECK(clip.joints[0].name == "Upper Arm");
    CHECK(clip.frames == io::parse_bvh(arm).frames);

    std::string old = arm; // lines that end as old Macs have them
    std::replace(old.begin(), old.end(), '\n', '\r');
    CHECK(io::parse_bvh(old).frames == io::parse_bvh(arm).frames);
}

TEST_CASE("BVH: what is written reads back as the same", "[io][bvh]") {
    for (const MotionClip& clip : {test::walking_clip(), io::parse_bvh(arm)}) {
        const MotionClip back = io::parse_bvh(io::clip_to_bvh(clip));
        REQUIRE(back.joints.size() == clip.joints.size());
        for (std::size_t j = 0; j < clip.joints.size(); ++j) {
            CHECK(back.joints[j].name == clip.joints[j].name);
            CHECK(back.joints[j].parent == clip.joints[j].parent);
            CHECK(back.joints[j].offset == clip.joints[j].offset);
            CHECK(back.joints[j].channels == clip.joints[j].channels);
            CHECK(back.joints[j].end == clip.joints[j].end);
        }
        CHECK(back.frames == clip.frames);
        CHECK(back.seconds_per_frame == clip.seconds_per_frame);
    }
    // The sample is this clip.
    CHECK(io::read_bvh(SKELGEN_DATA "/sample/walk.bvh").frames == test::walking_clip().frames);
}

TEST_CASE("the sample clip's feet stay where they stand", "[io][bvh]") {
    const MotionClip clip = io::read_bvh(SKELGEN_DATA "/sample/walk.bvh");
    int standing = 0;
    for (const char* name : {"LeftToeBase", "RightToeBase"}) {
        const auto joint = static_cast<std::size_t>(
            std::find_if(clip.joints.begin(), clip.joints.end(), [&](const auto& j) { return j.name == name; }) -
            clip.joints.begin());
        std::optional<Eigen::Vector3d> place;
        for (std::size_t f = 0; f < 30; ++f) {
            const Eigen::Vector3d now = pose_in(clip, f).positions[joint];
            CHECK(now.y() > 0.9); // centimetres; its sole is 1 below
            if (now.y() > 1.1) {
                place.reset();
                continue;
            }
            if (!place) place = now;
            CHECK((now - *place).norm() < 0.1);
            ++standing;
        }
    }
    CHECK(standing == 36); // of 60: both do for 6 frames
}

TEST_CASE("BVH: positions stand for offsets or come on top of them", "[io][bvh]") {
    const auto clip_with = [](const std::string& shoulder, const std::string& elbow) {
        return io::parse_bvh("HIERARCHY\nROOT Chest\n{\nOFFSET 0 90 0\nCHANNELS 3 Xposition Yposition Zposition\n"
                             "JOINT Shoulder\n{\nOFFSET 20 0 0\nCHANNELS 3 Xposition Yposition Zposition\n"
                             "JOINT Elbow\n{\nOFFSET 30 1 0\nCHANNELS 4 Zrotation Yposition Zposition Xposition\n"
                             "JOINT Wrist\n{\nOFFSET 25 0 0\nCHANNELS 1 Zrotation\n}\n}\n}\n}\nMOTION\nFrames: 1\n"
                             "Frame Time: 0.1\n0 0 0 " +
                             shoulder + " 0 " + elbow + " 0\n");
    };
    const auto stands = [](const MotionClip& clip) {
        const auto places = pose_in(clip, 0).positions;
        CHECK(places[0] == Eigen::Vector3d(0, 0, 0)); // where the root is, the motion says
        CHECK((places[1] - Eigen::Vector3d(21, 0, 0)).norm() < 1e-12);
        CHECK((places[2] - Eigen::Vector3d(51, 1, 2)).norm() < 1e-12);
        CHECK((places[3] - Eigen::Vector3d(76, 1, 2)).norm() < 1e-12);
    };
    stands(clip_with("21 0 0", "1 2 30"));
    stands(clip_with("1 0 0", "0 2 0"));
}

TEST_CASE("BVH: joints in another order than the hierarchy's take their numbers with them", "[io][bvh]") {
    MotionClip clip = test::standing_clip();
    // Side by side: parents still come first.
    const std::vector<std::size_t> order{0, 14, 18, 1, 15, 19, 2, 16, 20, 17, 21, 3, 6, 10, 4, 7, 11, 8, 12, 5, 9, 13};
    MotionClip mixed = clip;
    mixed.joints.clear();
    std::vector<int> place(clip.joints.size());
    for (std::size_t i = 0; i < order.size(); ++i) place[order[i]] = static_cast<int>(i);
    for (std::size_t i = 0; i < order.size(); ++i) {
        mixed.joints.push_back(clip.joints[order[i]]);
        if (int& parent = mixed.joints.back().parent; parent >= 0) parent = place[static_cast<std::size_t>(parent)];
    }
    for (Eigen::Index i = 0; i < mixed.frames.cols(); ++i) mixed.frames(0, i) = static_cast<double>(i % 50);
    const MotionClip back = io::parse_bvh(io::clip_to_bvh(mixed));
    const auto want = pose_in(mixed, 0), have = pose_in(back, 0);
    for (std::size_t j = 0; j < back.joints.size(); ++j)
        for (std::size_t i = 0; i < mixed.joints.size(); ++i)
            if (mixed.joints[i].name == back.joints[j].name)
                CHECK((want.positions[i] - have.positions[j]).norm() < 1e-9);
}

TEST_CASE("BVH: damaged files are refused with the line", "[io][bvh]") {
    const std::vector<std::pair<std::pair<std::string, std::string>, std::string>> damages{
        {{"HIERARCHY", "HIRARCHY"}, "line 1: HIERARCHY is missing"},
        {{"ROOT Upper Arm", "JOINT Upper Arm"}, "ROOT is missing"},
        {{"ROOT Upper Arm", "ROOT"}, "name is missing"},
        {{"OFFSET 1 2 3", "OFFSET 1 2"}, "no usable number"},
        {{"OFFSET 1 2 3", "OFFSET 1 2 1e39"}, "too large"},
        {{"OFFSET 1 2 3", "OFFSET 1 2 3 OFFSET 1 2 3"}, "two offsets"},
        {{"OFFSET 10 0 0\n", "\n"}, "has no OFFSET"},
        {{"CHANNELS 1 Zrotation", "CHANNELS 1 Zrotation CHANNELS 1 Zrotation"}, "channels twice"},
        {{"CHANNELS 6 Yrotation", "CHANNELS 6 Yscale"}, "none of Xposition"},
        {{"CHANNELS 6", "CHANNELS 7"}, "up to 6"},
        {{"CHANNELS 6", "CHANNELS -1"}, "up to 6"},
        {{"CHANNELS 6 Yrotation", "CHANNELS 6 Zrotation"}, "Zrotation twice"},
        {{"JOINT", "JOINTS"}, "JOINT, End Site or } is missing"},
        {{"}\nMOTION", "MOTION"}, "is missing"},
        {{"MOTION", "ROOT B { OFFSET 0 0 0 }\nMOTION"}, "second ROOT"},
        {{"Frames: 2", "Frames: 0"}, "no frames"},
        {{"Frames: 2", "Frames: 3"}, "3 frames"},
        {{"Frames: 2", "Frames: 999999999999999999"}, "999999999999999999 frames"},
        {{"Frames: 2", "Frames: 1"}, "more numbers than 1"},
        {{"Frames: 2", "Frames 2"}, "\"Frames:\" is missing"},
        {{"Frame Time: 0.04", "Frame Rate: 25"}, "\"Frame Time:\" is missing"},
        {{"Frame Time: 0.04", "Frame Time: 0"}, "not above zero"},
        {{"Frame Time: 0.04", "Frame Time: 1e-300"}, "line 18: the frame time is too small"},
        {{"Frame Time: 0.04", "Frame Time: 3e38"}, "line 18: the frame time is too large"},
        {{"90 90\n", "90 nan\n"}, "line 20: the channel's value is no usable number: 'nan'"},
    };
    for (const auto& [change, message] : damages) {
        std::string text = arm;
        const auto at = text.find(change.first);
        REQUIRE(at != std::string::npos);
        text.replace(at, change.first.size(), change.second);
        INFO(change.second);
        try {
            static_cast<void>(io::parse_bvh(text));
            FAIL("was read");
        } catch (const Error& error) {
            CHECK(error.code() == ErrorCode::bad_input);
            CHECK_THAT(error.what(), Catch::Matchers::Contains(message));
            CHECK_THAT(error.what(), Catch::Matchers::Contains("line "));
        }
    }
    std::string deep = "HIERARCHY ROOT a { OFFSET 0 0 0 ";
    for (int i = 0; i < 600; ++i) deep += "JOINT a\n{ OFFSET 0 0 0 ";
    CHECK_THROWS_WITH(io::parse_bvh(deep), Catch::Matchers::Contains("500 deep"));
    CHECK_THROWS_WITH(io::parse_bvh("HIERARCHY ROOT a\n{ OFFSET 0 0 0 }\nMOTION\nFrames: 9\nFrame Time: 1\n"),
                      Catch::Matchers::Contains("nothing moves"));
    CHECK_THROWS_AS(io::read_bvh("missing.bvh"), Error);
}

TEST_CASE("BVH: what would fill a machine is refused", "[io][bvh]") {
    std::string wide = "HIERARCHY ROOT a\n{ OFFSET 0 0 0 CHANNELS 1 Xrotation ";
    for (int i = 0; i < 5000; ++i) wide += "JOINT a\n{ OFFSET 0 0 0 } ";
    wide += "}\nMOTION\nFrames: 1\nFrame Time: 1\n0\n";
    CHECK_THROWS_WITH(io::parse_bvh(wide), Catch::Matchers::Contains("more than 5000 joints"));
    std::string longest = "HIERARCHY ROOT a\n{ OFFSET 0 0 0 CHANNELS 1 Xrotation }\nMOTION\nFrames: 1000001\n"
                          "Frame Time: 1\n";
    for (int i = 0; i < 1000001; ++i) longest += "0\n";
    CHECK_THROWS_WITH(io::parse_bvh(longest), Catch::Matchers::Contains("more than 1000000 frames"));
}

TEST_CASE("BVH: a clip that is none is not written", "[io][bvh]") {
    CHECK_THROWS_AS(io::clip_to_bvh({}), Error);
    MotionClip clip = test::standing_clip();
    clip.joints[14].parent = -1;
    CHECK_THROWS_WITH(io::clip_to_bvh(clip), Catch::Matchers::Contains("one root, not 2"));
    clip = test::standing_clip();
    clip.frames.conservativeResize(Eigen::NoChange, 6);
    CHECK_THROWS_AS(io::clip_to_bvh(clip), Error);
}

} // namespace
