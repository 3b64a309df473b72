#include <array>
#include <string>
#include <vector>

#include <skelgen/applications/clip_body.hpp>
#include <skelgen/core/error.hpp>

#include "catch.hpp"
#include "walking_clip.hpp"

namespace {

using namespace skelgen;
using namespace skelgen::applications;

/// What a convention calls the joints of `standing_clip`: pelvis to head, then those of the left side and of the right.
struct Naming {
    std::string convention;
    std::vector<std::string> trunk, left, right;
};

MotionClip named(const Naming& naming) {
    MotionClip clip = test::standing_clip();
    for (std::size_t j = 0; j < 6; ++j) clip.joints[j].name = naming.trunk.at(j);
    for (std::size_t i = 0; i < 4; ++i) {
        clip.joints[6 + i].name = naming.left.at(i);
        clip.joints[10 + i].name = naming.right.at(i);
        clip.joints[14 + i].name = naming.left.at(4 + i);
        clip.joints[18 + i].name = naming.right.at(4 + i);
    }
    return clip;
}

const std::vector<Naming> namings{
    {"Mixamo",
     {"mixamorig:Hips", "mixamorig:Spine", "mixamorig:Spine1", "mixamorig:Spine2", "mixamorig:Neck", "mixamorig:Head"},
     {"mixamorig:LeftShoulder", "mixamorig:LeftArm", "mixamorig:LeftForeArm", "mixamorig:LeftHand",
      "mixamorig:LeftUpLeg", "mixamorig:LeftLeg", "mixamorig:LeftFoot", "mixamorig:LeftToeBase"},
     {"mixamorig:RightShoulder", "mixamorig:RightArm", "mixamorig:RightForeArm", "mixamorig:RightHand",
      "mixamorig:RightUpLeg", "mixamorig:RightLeg", "mixamorig:RightFoot", "mixamorig:RightToeBase"}},
    {"VRM",
     {"hips", "spine", "chest", "upperChest", "neck", "head"},
     {"leftShoulder", "leftUpperArm", "leftLowerArm", "leftHand", "leftUpperLeg", "leftLowerLeg", "leftFoot",
      "leftToes"},
     {"rightShoulder", "rightUpperArm", "rightLowerArm", "rightHand", "rightUpperLeg", "rightLowerLeg", "rightFoot",
      "rightToes"}},
    {"VRoid",
     {"J_Bip_C_Hips", "J_Bip_C_Spine", "J_Bip_C_Chest", "J_Bip_C_UpperChest", "J_Bip_C_Neck", "J_Bip_C_Head"},
     {"J_Bip_L_Shoulder", "J_Bip_L_UpperArm", "J_Bip_L_LowerArm", "J_Bip_L_Hand", "J_Bip_L_UpperLeg",
      "J_Bip_L_LowerLeg", "J_Bip_L_Foot", "J_Bip_L_ToeBase"},
     {"J_Bip_R_Shoulder", "J_Bip_R_UpperArm", "J_Bip_R_LowerArm", "J_Bip_R_Hand", "J_Bip_R_UpperLeg",
      "J_Bip_R_LowerLeg", "J_Bip_R_Foot", "J_Bip_R_ToeBase"}},
    {"SMPL",
     {"Pelvis", "Spine1", "Spine2", "Spine3", "Neck", "Head"},
     {"L_Collar", "L_Shoulder", "L_Elbow", "L_Wrist", "L_Hip", "L_Knee", "L_Ankle", "L_Foot"},
     {"R_Collar", "R_Shoulder", "R_Elbow", "R_Wrist", "R_Hip", "R_Knee", "R_Ankle", "R_Foot"}},
    {"SMPL in Maya",
     {"m_avg_Pelvis", "m_avg_Spine1", "m_avg_Spine2", "m_avg_Spine3", "m_avg_Neck", "m_avg_Head"},
     {"m_avg_L_Collar", "m_avg_L_Shoulder", "m_avg_L_Elbow", "m_avg_L_Wrist", "m_avg_L_Hip", "m_avg_L_Knee",
      "m_avg_L_Ankle", "m_avg_L_Foot"},
     {"m_avg_R_Collar", "m_avg_R_Shoulder", "m_avg_R_Elbow", "m_avg_R_Wrist", "m_avg_R_Hip", "m_avg_R_Knee",
      "m_avg_R_Ankle", "m_avg_R_Foot"}},
    {"Biovision",
     {"Hips", "Chest", "Chest2", "Chest3", "Neck", "Head"},
     {"LeftCollar", "LeftShoulder", "LeftElbow", "LeftWrist", "LeftHip", "LeftKnee", "LeftAnkle", "LeftToe"},
     {"RightCollar", "RightShoulder", "RightElbow", "RightWrist", "RightHip", "RightKnee", "RightAnkle", "RightToe"}},
    {"Poser",
     {"hip", "abdomen", "waist", "chest", "neck", "head"},
     {"lCollar", "lShldr", "lForeArm", "lHand", "lThigh", "lShin", "lFoot", "lToe"},
     {"rCollar", "rShldr", "rForeArm", "rHand", "rThigh", "rShin", "rFoot", "rToe"}},
    {"hip, knee, ankle",
     {"hip", "abdomen", "waist", "chest", "neck", "head"},
     {"lCollar", "lShoulder", "lElbow", "lWrist", "lHip", "lKnee", "lAnkle", "lToes"},
     {"rCollar", "rShoulder", "rElbow", "rWrist", "rHip", "rKnee", "rAnkle", "rToes"}},
    {"Biped",
     {"Bip01 Pelvis", "Bip01 Spine", "Bip01 Spine1", "Bip01 Spine2", "Bip01 Neck", "Bip01 Head"},
     {"Bip01 L Clavicle", "Bip01 L UpperArm", "Bip01 L Forearm", "Bip01 L Hand", "Bip01 L Thigh", "Bip01 L Calf",
      "Bip01 L Foot", "Bip01 L Toe0"},
     {"Bip01 R Clavicle", "Bip01 R UpperArm", "Bip01 R Forearm", "Bip01 R Hand", "Bip01 R Thigh", "Bip01 R Calf",
      "Bip01 R Foot", "Bip01 R Toe0"}},
    {"Unreal",
     {"pelvis", "spine_01", "spine_02", "spine_03", "neck_01", "head"},
     {"clavicle_l", "upperarm_l", "lowerarm_l", "hand_l", "thigh_l", "calf_l", "foot_l", "ball_l"},
     {"clavicle_r", "upperarm_r", "lowerarm_r", "hand_r", "thigh_r", "calf_r", "foot_r", "ball_r"}},
    {"Blender",
     {"hips", "spine", "spine.001", "spine.002", "neck", "head"},
     {"shoulder.L", "upper_arm.L", "forearm.L", "hand.L", "thigh.L", "shin.L", "foot.L", "toe.L"},
     {"shoulder.R", "upper_arm.R", "forearm.R", "hand.R", "thigh.R", "shin.R", "foot.R", "toe.R"}},
    {"Rigify", // DEF: the bones that deform; its spine ends in the head
     {"DEF-spine", "DEF-spine.001", "DEF-spine.002", "DEF-spine.003", "DEF-spine.004", "DEF-spine.005"},
     {"DEF-shoulder.L", "DEF-upper_arm.L", "DEF-forearm.L", "DEF-hand.L", "DEF-thigh.L", "DEF-shin.L", "DEF-foot.L",
      "DEF-toe.L"},
     {"DEF-shoulder.R", "DEF-upper_arm.R", "DEF-forearm.R", "DEF-hand.R", "DEF-thigh.R", "DEF-shin.R", "DEF-foot.R",
      "DEF-toe.R"}},
    {"Auto-Rig Pro",
     {"root.x", "spine_01.x", "spine_02.x", "spine_03.x", "neck.x", "head.x"},
     {"shoulder.l", "arm_stretch.l", "forearm_stretch.l", "hand.l", "thigh_stretch.l", "leg_stretch.l", "foot.l",
      "toes_01.l"},
     {"shoulder.r", "arm_stretch.r", "forearm_stretch.r", "hand.r", "thigh_stretch.r", "leg_stretch.r", "foot.r",
      "toes_01.r"}},
    {"Daz's Genesis",
     {"hip", "abdomenLower", "abdomenUpper", "chestLower", "neckLower", "head"},
     {"lCollar", "lShldrBend", "lForearmBend", "lHand", "lThighBend", "lShin", "lFoot", "lToe"},
     {"rCollar", "rShldrBend", "rForearmBend", "rHand", "rThighBend", "rShin", "rFoot", "rToe"}},
    {"Advanced Skeleton",
     {"Root_M", "Spine1_M", "Spine2_M", "Chest_M", "Neck_M", "Head_M"},
     {"Scapula_L", "Shoulder_L", "Elbow_L", "Wrist_L", "Hip_L", "Knee_L", "Ankle_L", "Toes_L"},
     {"Scapula_R", "Shoulder_R", "Elbow_R", "Wrist_R", "Hip_R", "Knee_R", "Ankle_R", "Toes_R"}},
    {"Motive",
     {"Hip", "Ab", "Ab2", "Chest", "Neck", "Head"},
     {"LShoulder", "LUArm", "LFArm", "LHand", "LThigh", "LShin", "LFoot", "LToe"},
     {"RShoulder", "RUArm", "RFArm", "RHand", "RThigh", "RShin", "RFoot", "RToe"}},
    {"Source 2",
     {"pelvis", "spine_0", "spine_1", "spine_2", "neck_0", "head_0"},
     {"clavicle_L", "arm_upper_L", "arm_lower_L", "hand_L", "leg_upper_L", "leg_lower_L", "ankle_L", "ball_L"},
     {"clavicle_R", "arm_upper_R", "arm_lower_R", "hand_R", "leg_upper_R", "leg_lower_R", "ankle_R", "ball_R"}},
    {"3ds Max's CAT",
     {"CATRigPelvis", "CATRigSpine1", "CATRigSpine2", "CATRigRibcage", "CATRigNeck", "CATRigHead"},
     {"CATRigLCollarbone", "CATRigLUpperarm", "CATRigLForearm", "CATRigLPalm", "CATRigLThigh", "CATRigLCalf",
      "CATRigLAnkle", "CATRigLToe1"},
     {"CATRigRCollarbone", "CATRigRUpperarm", "CATRigRForearm", "CATRigRPalm", "CATRigRThigh", "CATRigRCalf",
      "CATRigRAnkle", "CATRigRToe1"}},
    {"leg above knee",
     {"Hips", "Spine", "Chest", "Upper Chest", "Neck", "Head"},
     {"Left shoulder", "Left arm", "Left elbow", "Left wrist", "Left leg", "Left knee", "Left ankle", "Left toe"},
     {"Right shoulder", "Right arm", "Right elbow", "Right wrist", "Right leg", "Right knee", "Right ankle",
      "Right toe"}},
    {"Acclaim",
     {"root", "lowerback", "upperback", "thorax", "lowerneck", "head"},
     {"lclavicle", "lhumerus", "lradius", "lwrist", "lfemur", "ltibia", "lfoot", "ltoes"},
     {"rclavicle", "rhumerus", "rradius", "rwrist", "rfemur", "rtibia", "rfoot", "rtoes"}},
    {"in front, in capitals",
     {"ROBOT_HIPS", "ROBOT_SPINE", "ROBOT_SPINE1", "ROBOT_SPINE2", "ROBOT_NECK", "ROBOT_HEAD"},
     {"ROBOT_LEFT_SHOULDER", "ROBOT_LEFT_ARM", "ROBOT_LEFT_FORE_ARM", "ROBOT_LEFT_HAND", "ROBOT_LEFT_UP_LEG",
      "ROBOT_LEFT_LEG", "ROBOT_LEFT_FOOT", "ROBOT_LEFT_TOE_BASE"},
     {"ROBOT_RIGHT_SHOULDER", "ROBOT_RIGHT_ARM", "ROBOT_RIGHT_FORE_ARM", "ROBOT_RIGHT_HAND", "ROBOT_RIGHT_UP_LEG",
      "ROBOT_RIGHT_LEG", "ROBOT_RIGHT_FOOT", "ROBOT_RIGHT_TOE_BASE"}},
};

TEST_CASE("clips: bodies are found by all common names of joints", "[applications][clip]") {
    for (const Naming& naming : namings) {
        INFO(naming.convention);
        const auto body = find_body(named(naming));
        if (!body) FAIL(body.failure().what);
        CHECK(body->pelvis == 0);
        CHECK(body->spine == std::vector<int>{1, 2});
        CHECK(body->chest == 3);
        CHECK(body->neck == std::vector<int>{4});
        CHECK(body->head == 5);
        for (const int side : {0, 1}) {
            const int first = 6 + 4 * side;
            const ClipLimb &arm = body->arms.at(static_cast<std::size_t>(side)),
                           &leg = body->legs.at(static_cast<std::size_t>(side));
            CHECK(std::vector<int>{arm.upper, arm.lower, arm.end, arm.tip} ==
                  std::vector<int>{first + 1, first + 2, first + 3, -1});
            CHECK(std::vector<int>{leg.upper, leg.lower, leg.end, leg.tip} ==
                  std::vector<int>{first + 8, first + 9, first + 10, first + 11});
        }
    }
}

TEST_CASE("clips: stubs, helpers and fingers are told from the joints that they stand beside", "[applications][clip]") {
    MotionClip clip = test::standing_clip();
    const auto add = [&](const char* name, int parent) { clip.joints.push_back({name, parent, {1, 0, 0}}); };
    add("LeftHip", 0); // stubs, as of MotionBuilder's and Acclaim's skeletons
    add("LHipJoint", 0);
    add("LeftForeArmRoll", 8);
    add("LeftFoot_IK", -1);
    add("LeftHandThumb1", 9);
    add("LeftHandMiddle1", 9);
    add("LeftHandMiddle2", 27);
    add("HeadTop_End", 5);
    auto body = find_body(clip);
    REQUIRE(body);
    CHECK(body->legs[0].upper == 14);
    CHECK(body->legs[0].end == 16);
    CHECK(body->arms[0].lower == 8);
    CHECK(body->arms[0].tip == 27);
    CHECK(body->head == 5);

    clip = test::standing_clip(); // skelgen's own: shoulder, elbow, wrist and hand
    for (const std::size_t first : {6U, 10U}) {
        const std::string side = first == 6 ? "left_" : "right_";
        for (const std::size_t i : {0U, 1U, 2U, 3U})
            clip.joints[first + i].name = side + std::array{"collar", "shoulder", "elbow", "wrist"}.at(i);
    }
    clip.joints.push_back({"left_hand", 9, {8, 0, 0}});
    body = find_body(clip);
    REQUIRE(body);
    CHECK(body->arms[0].end == 9);
    CHECK(body->arms[0].tip == 22);
}

TEST_CASE("clips: a pelvis beside the spine, both on the hip, holds the legs", "[applications][clip]") {
    MotionClip clip = test::standing_clip(); // as Daz and Character Creator have it
    clip.joints[0].name = "hip";
    clip.joints.insert(clip.joints.begin() + 1, {"pelvis", 0, {0, 0, 0}});
    for (std::size_t j = 2; j < clip.joints.size(); ++j) {
        ClipJoint& joint = clip.joints[j];
        if (joint.parent > 0)
            ++joint.parent;
        else if (joint.name == "LeftUpLeg" || joint.name == "RightUpLeg")
            joint.parent = 1;
    }
    const auto body = find_body(clip);
    if (!body) FAIL(body.failure().what);
    CHECK(body->pelvis == 1);
    CHECK(body->spine == std::vector<int>{2, 3});
    CHECK(body->chest == 4);
    CHECK(body->legs[1].upper == 19);
}

TEST_CASE("clips: what is missing is named", "[applications][clip]") {
    const auto fault = [](const std::string& joint, const std::string& name, int parent = -2) {
        MotionClip clip = test::standing_clip();
        for (ClipJoint& each : clip.joints)
            if (each.name == joint) {
                each.name = name;
                if (parent > -2) each.parent = parent;
            }
        const auto body = find_body(clip);
        return body ? std::string() : body.failure().what;
    };
    CHECK(fault("Spine", "whatever").empty());
    CHECK_THAT(fault("LeftLeg", "b12"), Catch::Matchers::Contains("left shin"));
    CHECK_THAT(fault("RightArm", "b12"), Catch::Matchers::Contains("left and right upper arm are named differently"));
    CHECK_THAT(fault("RightForeArm", "b12"), Catch::Matchers::Contains("no joint is named as a right forearm"));
    CHECK(fault("Head", "b12").empty()); // the neck is the last that is known of it
    CHECK_THAT(fault("RightFoot", "RightFoot", 0), Catch::Matchers::Contains("right foot does not hang on the shin"));
    CHECK_THAT(fault("Head", "Head", -1), Catch::Matchers::Contains("do not hang together"));
    MotionClip two_halves = test::standing_clip(); // each side hangs on a root of its own
    for (ClipJoint& joint : two_halves.joints)
        if (joint.name == "LeftUpLeg" || joint.name == "RightUpLeg") joint.parent = -1;
    const auto halves = find_body(two_halves);
    REQUIRE_FALSE(halves);
    CHECK_THAT(halves.failure().what, Catch::Matchers::Contains("do not hang together"));
    MotionClip headless = test::standing_clip();
    headless.joints[4].name = headless.joints[5].name = "b12";
    CHECK_THAT(find_body(headless).failure().what, Catch::Matchers::Contains("no joint is named as a head"));
    MotionClip nobody;
    nobody.joints.push_back({"root", -1, {0, 0, 0}});
    CHECK_FALSE(find_body(nobody));
}

TEST_CASE("clips: joints before their parents, or frames of another skeleton, are refused", "[applications][clip]") {
    for (const int parent : {1, 2, -2}) { // itself, one below it, none that there is
        MotionClip clip = test::standing_clip();
        clip.joints[1].parent = parent;
        CHECK_THROWS_AS(validate(clip), Error);
        CHECK_THROWS_AS(find_body(clip), Error);
        CHECK_THROWS_AS(rest_pose(clip), Error);
        CHECK_THROWS_AS(pose_in(clip, 0), Error);
    }
    MotionClip clip = test::standing_clip();
    clip.joints[1].channels.pop_back();
    CHECK_THROWS_AS(validate(clip), Error);
}

} // namespace
