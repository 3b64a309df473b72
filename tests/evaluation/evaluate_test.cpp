#include <skelgen/evaluation/evaluate.hpp>

#include <fstream>
#include <limits>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include <skelgen/core/builtin_templates.hpp>
#include <skelgen/core/error.hpp>
#include <skelgen/evaluation/report.hpp>

#include "catch.hpp"
#include "temporary_folder.hpp"

namespace {

using namespace skelgen;
using namespace skelgen::evaluation;
using namespace skelgen::io;
using skelgen::test::TemporaryFolder;
using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

/// A body of sticks: left is +x, up is +z; the largest geodesic distance is 2.
JointPositions stick_body() {
    JointPositions joints{{"crotch", {0, 0, 1}},
                          {"waist", {0, 0, 1.1}},
                          {"chest", {0, 0, 1.4}},
                          {"neck", {0, 0, 1.5}},
                          {"head", {0, 0, 1.7}}};
    for (const auto& [side, x] : {std::pair<std::string, double>{"left_", 1}, {"right_", -1}}) {
        joints[side + "shoulder"] = {0.2 * x, 0, 1.4};
        joints[side + "elbow"] = {0.5 * x, 0, 1.4};
        joints[side + "wrist"] = {0.7 * x, 0, 1.4};
        joints[side + "hand"] = {0.8 * x, 0, 1.4};
        joints[side + "hip"] = {0.1 * x, 0, 0.9};
        joints[side + "knee"] = {0.1 * x, 0, 0.5};
        joints[side + "ankle"] = {0.1 * x, 0, 0.1};
        joints[side + "foot"] = {0.1 * x, 0.1, 0};
    }
    return joints;
}

GroundTruth stick_truth() {
    const JointPositions body = stick_body();
    GroundTruth truth;
    truth.scale = 2;
    for (const char* joint : {"neck", "left_elbow", "right_elbow"}) truth.joints.emplace_back(joint, body.at(joint));
    for (const auto& [name, position] : body) truth.markers[name] = position;
    return truth;
}

void write_skeleton_of(const JointPositions& joints, const fs::path& file) {
    Json document{{"joints", Json::array()}};
    for (const auto& [name, p] : joints)
        document["joints"].push_back({{"name", name}, {"position", {p.x(), p.y(), p.z()}}});
    fs::create_directories(file.parent_path());
    std::ofstream(file) << document;
}

void write_truth(const GroundTruth& truth, const fs::path& file) {
    Json document{{"scale", truth.scale}};
    for (const auto& [name, p] : truth.joints) document["joints"][name] = {p.x(), p.y(), p.z()};
    for (const auto& [name, p] : truth.markers) document["markers"][name] = {p.x(), p.y(), p.z()};
    fs::create_directories(file.parent_path());
    std::ofstream(file) << document;
}

TEST_CASE("the truth itself is solved without error") {
    const MeshScore score = score_joints(stick_truth(), stick_body());
    CHECK(score.solved());
    REQUIRE(score.errors.size() == 3);
    CHECK(score.errors[0] == std::pair<std::string, double>("neck", 0));
}

TEST_CASE("errors are distances over the truth's scale, in the truth's order") {
    JointPositions joints = stick_body();
    joints["left_elbow"] += Vector3<double>(0.03, 0.04, 0);
    const MeshScore score = score_joints(stick_truth(), joints);
    CHECK(score.solved());
    CHECK(score.errors[1].first == "left_elbow");
    CHECK(score.errors[1].second == Approx(0.025).epsilon(1e-12));
    CHECK(score.errors[2].second == 0);
}

TEST_CASE("fingers and toes that truth and skeleton have are scored for themselves") {
    const TemporaryFolder folder;
    GroundTruth truth = stick_truth();
    JointPositions joints = stick_body();
    const auto place = [](double x) { return Vector3<double>(x, 0, 0); };
    for (const char* name : {"left_toe1_1", "left_index_1", "left_thumb_2", "right_toe5_2"})
        truth.digits.emplace_back(name, place(1));
    joints["left_thumb_2"] = place(1.02);
    joints["left_toe1_1"] = place(1.06);
    joints["left_toe2_1"] = place(0); // which the truth does not know
    const MeshScore score = score_joints(truth, joints);
    CHECK(score.solved());
    CHECK(score.errors.size() == 3);
    REQUIRE(score.digits.size() == 2);
    const SetSummary summary = summarise({"set", {score}});
    CHECK(summary.errors->mean == 0);
    REQUIRE(summary.digits.has_value());
    CHECK(summary.digits->count == 2);
    CHECK(summary.digits->mean == Approx(0.02).epsilon(1e-12));
    const std::string text = summary_to_text(summary);
    CHECK(text.find("  all             0.0000") < text.find("  left_thumb_2    0.0100"));
    CHECK(text.find("  left_thumb_2") < text.find("  left_toe1_1     0.0300"));
    CHECK(text.find("  left_toe1_1") < text.find("  all digits      0.0200"));
    CHECK(summaries_to_csv({summary}).find("\nset,all digits,2,0.02") != std::string::npos);
    const Json json = Json::parse(scores_to_json({{"set", {score}}}, true))["set"];
    CHECK(json["digits"]["left_toe1_1"]["mean"].get<double>() == Approx(0.03));
    CHECK(json["per_mesh"][""]["digits"]["left_thumb_2"].get<double>() == Approx(0.01));
    CHECK_FALSE(json["joints"].contains("left_thumb_2"));

    joints.erase("left_thumb_2");
    joints.erase("left_toe1_1");
    CHECK_FALSE(summarise({"set", {score_joints(truth, joints)}}).digits.has_value());
}

TEST_CASE("a truth file may have fingers and toes, and refuses what is no place") {
    const TemporaryFolder folder;
    write_truth(stick_truth(), folder / "truth.json");
    Json document = Json::parse(std::ifstream(folder / "truth.json"));
    CHECK(read_ground_truth(folder / "truth.json").digits.empty());
    document["toes"]["left_toe1_1"] = {1, 2, 3};
    document["fingers"]["left_index_1"] = {4, 5, 6};
    std::ofstream(folder / "truth.json") << document;
    const GroundTruth truth = read_ground_truth(folder / "truth.json");
    REQUIRE(truth.digits.size() == 2);
    CHECK(truth.digits[0].first == "left_index_1");
    CHECK(truth.digits[1].second == Vector3<double>(1, 2, 3));
    document["toes"]["left_toe1_1"] = "here";
    std::ofstream(folder / "truth.json") << document;
    CHECK_THROWS_AS(read_ground_truth(folder / "truth.json"), Error);
}

TEST_CASE("a skeleton that lacks a joint, or has one nowhere, is not complete") {
    JointPositions joints = stick_body();
    SECTION("missing") { joints.erase("left_wrist"); }
    SECTION("not finite") { joints["waist"].x() = std::numeric_limits<double>::quiet_NaN(); }
    const MeshScore score = score_joints(stick_truth(), joints);
    CHECK_FALSE(score.complete);
    CHECK_FALSE(score.limbs);
    CHECK_FALSE(score.sides);
    CHECK(score.errors.empty());
}

TEST_CASE("arms taken for one another are flipped, and their hands wrong limbs") {
    JointPositions joints = stick_body();
    for (const std::string joint : {"shoulder", "elbow", "wrist", "hand"})
        std::swap(joints["left_" + joint], joints["right_" + joint]);
    const MeshScore score = score_joints(stick_truth(), joints);
    CHECK(score.complete);
    CHECK(score.wrong_limbs == std::vector<std::string>{"left_hand", "right_hand"});
    CHECK(score.flipped == std::vector<std::string>{"left_hand", "right_hand", "left_elbow", "right_elbow",
                                                    "left_shoulder", "right_shoulder"});
    CHECK_FALSE(score.solved());
}

TEST_CASE("what a body lacks has to be missing, and all else is scored") {
    GroundTruth truth = stick_truth();
    truth.missing = {"left_hand", "right_elbow", "right_wrist", "right_hand"};
    CHECK_FALSE(score_joints(truth, stick_body()).complete);
    JointPositions joints = stick_body();
    for (const std::string& name : truth.missing) joints.erase(name);
    const MeshScore score = score_joints(truth, joints);
    CHECK(score.solved());
    REQUIRE(score.errors.size() == 2); // neck and left elbow
    CHECK(score.errors[1].first == "left_elbow");
    joints.erase("left_wrist");
    CHECK_FALSE(score_joints(truth, joints).complete);
}

TEST_CASE("a limb further than 0.12 from its marker is wrong though its side is right") {
    JointPositions joints = stick_body();
    joints["head"].z() += 0.239; // the scale is 2
    CHECK(score_joints(stick_truth(), joints).solved());
    joints["head"].z() += 0.002;
    const MeshScore score = score_joints(stick_truth(), joints);
    CHECK(score.wrong_limbs == std::vector<std::string>{"head"});
    CHECK(score.sides);
}

TEST_CASE("a joint half-way between both sides is flipped") {
    JointPositions joints = stick_body();
    joints["left_knee"].x() = 0;
    CHECK(score_joints(stick_truth(), joints).flipped == std::vector<std::string>{"left_knee"});
}

TEST_CASE("a truth that cannot be scored against is refused") {
    GroundTruth truth = stick_truth();
    SECTION("no marker") { truth.markers.erase("left_foot"); }
    SECTION("unknown joint") { truth.joints.emplace_back("tail", Vector3<double>::Zero()); }
    CHECK_THROWS_AS(score_joints(truth, stick_body()), Error);
}

/// Two solved meshes with known errors, one flipped, one missing.
SetScore scored_set(const fs::path& folder) {
    for (const char* name : {"a", "b", "c", "d"})
        write_truth(stick_truth(), folder / "truth/sticks" / (std::string(name) + ".json"));
    JointPositions a = stick_body();
    a["neck"].y() += 0.02;       // 0.01 of the scale
    a["left_elbow"].y() += 0.04; // 0.02
    JointPositions b = stick_body();
    b["neck"].y() += 0.06; // 0.03
    JointPositions c = stick_body();
    std::swap(c["left_knee"], c["right_knee"]);
    write_skeleton_of(a, folder / "results/sticks/a.json");
    write_skeleton_of(b, folder / "results/sticks/b.json");
    write_skeleton_of(c, folder / "results/sticks/c.json");
    const auto sets = evaluate_folders(folder / "truth", folder / "results");
    REQUIRE(sets.size() == 1);
    return sets[0];
}

TEST_CASE("a set's summary counts all meshes and takes errors from solved ones") {
    const TemporaryFolder folder;
    const SetSummary summary = summarise(scored_set(folder.path()));
    CHECK(summary.name == "sticks");
    CHECK(summary.meshes == 4);
    CHECK(summary.complete == 3);
    CHECK(summary.limbs == 3);
    CHECK(summary.sides == 2);
    CHECK(summary.solved == 2);
    CHECK_FALSE(summary.inside.has_value());

    REQUIRE(summary.per_joint.size() == 3);
    const auto& [joint, neck] = summary.per_joint[1];
    CHECK(joint == "neck");
    CHECK(neck.count == 2);
    CHECK(neck.mean == Approx(0.02).epsilon(1e-12));
    CHECK(neck.median == Approx(0.02).epsilon(1e-12));
    CHECK(neck.p95 == Approx(0.029).epsilon(1e-12));
    CHECK(neck.worst == Approx(0.03).epsilon(1e-12));
    CHECK(neck.worst_mesh == "b");

    // 0.01, 0.03, 0.02, 0, 0, 0
    REQUIRE(summary.errors.has_value());
    CHECK(summary.errors->mean == Approx(0.01).epsilon(1e-12));
    CHECK(summary.errors->median == Approx(0.005).epsilon(1e-12));
    CHECK(summary.errors->p95 == Approx(0.0275).epsilon(1e-12));
}

TEST_CASE("the reports hold the summary's numbers") {
    const TemporaryFolder folder;
    const SetScore set = scored_set(folder.path());
    const SetSummary summary = summarise(set);

    const std::string text = summary_to_text(summary);
    CHECK(text.find("sticks: solved 2/4 (complete 3, limbs right 3, sides right 2)") == 0);
    CHECK(text.find("neck            0.0200  0.0200  0.0290  0.0300  b\n") != std::string::npos);
    CHECK(text.find("all             0.0100  0.0050  0.0275  0.0300  b\n") != std::string::npos);

    CHECK(mesh_score_line("sticks", set.meshes[0]) == "sticks/a: solved, mean error 0.0100");
    CHECK(mesh_score_line("sticks", set.meshes[2]) ==
          "sticks/c: FAILED, mean error 0.0000, flipped left_knee,right_knee");
    CHECK(mesh_score_line("sticks", set.meshes[3]) == "sticks/d: FAILED, no complete skeleton");

    const Json json = Json::parse(scores_to_json({set}, true));
    CHECK(json["sticks"]["solved"] == 2);
    CHECK(json["sticks"]["mean_error"] == summary.errors->mean);
    CHECK(json["sticks"]["p95_error"] == summary.errors->p95);
    CHECK(json["sticks"]["inside"].is_null());
    CHECK(json["sticks"]["per_joint"]["neck"] == summary.per_joint[1].second.mean);
    CHECK(json["sticks"]["per_mesh"]["c"]["flipped"] == Json({"left_knee", "right_knee"}));
    CHECK(json["sticks"]["per_mesh"]["d"]["complete"] == false);

    const std::string csv = summaries_to_csv({summary});
    CHECK(csv.find("set,joint,count,mean,median,p95,worst,worst_mesh\nsticks,neck,2,") == 0);
    CHECK(csv.find("\nsticks,all,6,") != std::string::npos);
}

TEST_CASE("a folder without folders is one set") {
    const TemporaryFolder folder;
    write_truth(stick_truth(), folder.path() / "flat/a.json");
    write_skeleton_of(stick_body(), folder.path() / "results/a.json");
    const auto sets = evaluate_folders(folder.path() / "flat", folder.path() / "results");
    REQUIRE(sets.size() == 1);
    CHECK(sets[0].name == "flat");
    CHECK(sets[0].meshes[0].solved());
}

TEST_CASE("joints outside of the mesh are named and counted") {
    const TemporaryFolder folder;
    write_truth(stick_truth(), folder.path() / "truth/sticks/a.json");
    write_skeleton_of(stick_body(), folder.path() / "results/sticks/a.json");
    fs::create_directories(folder.path() / "meshes/sticks");
    // A box around everything but the left hand at x = 0.8.
    std::ofstream(folder.path() / "meshes/sticks/a.off")
        << "OFF\n8 6 0\n-1 -1 -1\n.75 -1 -1\n-1 1 -1\n.75 1 -1\n-1 -1 2\n.75 -1 2\n-1 1 2\n.75 1 2\n"
           "4 0 2 3 1\n4 4 5 7 6\n4 0 1 5 4\n4 2 6 7 3\n4 0 4 6 2\n4 1 3 7 5\n";
    const auto sets = evaluate_folders(folder.path() / "truth", folder.path() / "results", folder.path() / "meshes");
    REQUIRE(sets[0].meshes[0].outside.has_value());
    CHECK(*sets[0].meshes[0].outside == std::vector<std::string>{"left_hand"});
    CHECK(summarise(sets[0]).inside.value() == Approx(20.0 / 21));
}

TEST_CASE("results that cannot be read count as not complete") {
    const TemporaryFolder folder;
    const fs::path file = folder.path() / "result.json";
    SECTION("absent") {}
    SECTION("cut off") { std::ofstream(file) << "{\"joints\": [{\"name\": \"cro"; }
    SECTION("no joints") { std::ofstream(file) << "{}"; }
    SECTION("a joint without a position") { std::ofstream(file) << "{\"joints\": [{\"name\": \"crotch\"}]}"; }
    SECTION("a position of two numbers") {
        std::ofstream(file) << "{\"joints\": [{\"name\": \"crotch\", \"position\": [1, 2]}]}";
    }
    CHECK(read_joint_positions(file).empty());
}

TEST_CASE("joints that are said to be missing are no joints") {
    const TemporaryFolder folder;
    const fs::path file = folder.path() / "result.json";
    std::ofstream(file) << R"({"joints": [{"name": "left_wrist", "position": [1, 2, 3]},
                                          {"name": "left_hand", "parent": "left_wrist", "present": false}]})";
    const JointPositions joints = read_joint_positions(file);
    CHECK(joints.size() == 1);
    CHECK(joints.at("left_wrist") == Vector3<double>(1, 2, 3));
}

TEST_CASE("truth that cannot be read is an error that names the file") {
    const TemporaryFolder folder;
    const fs::path file = folder.path() / "truth.json";
    SECTION("absent") {}
    SECTION("cut off") { std::ofstream(file) << "{\"scale\": "; }
    SECTION("no scale") { std::ofstream(file) << "{\"joints\": {}, \"markers\": {}}"; }
    SECTION("scale of zero") { std::ofstream(file) << "{\"scale\": 0, \"joints\": {}, \"markers\": {}}"; }
    SECTION("joints in a list") { std::ofstream(file) << "{\"scale\": 1, \"joints\": [], \"markers\": {}}"; }
    try {
        (void)evaluate_file(file, folder.path() / "result.json");
        FAIL("was evaluated");
    } catch (const Error& error) {
        CHECK(error.code() == ErrorCode::bad_input);
        CHECK(std::string(error.what()).find(file.string()) == 0);
    }
}

/// The template's own animal, its tail's tip and the truth of it.
std::pair<JointPositions, GroundTruth> drawn_animal() {
    JointPositions joints;
    GroundTruth truth;
    truth.plan = BodyKind::quadruped;
    truth.scale = 0.8;
    for (const TemplateJoint& joint : builtin_template("quadruped").joints) {
        joints[joint.name] = joint.position;
        truth.joints.emplace_back(joint.name, joint.position);
    }
    for (const char* end : {"left_fore_foot", "right_fore_foot", "left_hind_foot", "right_hind_foot", "head"})
        truth.markers[end] = joints.at(end);
    truth.markers["tail"] = joints["tail_tip"] = {0, 0.3, -0.36};
    return {joints, truth};
}

TEST_CASE("an animal is solved with its tail; without it the tail is a wrong limb") {
    auto [joints, truth] = drawn_animal();
    CHECK(score_joints(truth, joints).solved());
    CHECK(score_joints(truth, joints).errors.size() == truth.joints.size());
    for (const char* gone : {"tail_tip", "tail1", "tail2", "tail3", "tail4"}) joints.erase(gone);
    const MeshScore without = score_joints(truth, joints);
    CHECK(without.complete);
    CHECK(without.wrong_limbs == std::vector<std::string>{"tail"});
    CHECK(without.errors.size() == truth.joints.size() - 4);
    truth.markers.erase("tail"); // of which nothing is known
    CHECK(score_joints(truth, joints).solved());
    joints.erase("left_fore_ankle");
    CHECK_FALSE(score_joints(truth, joints).complete);
}

TEST_CASE("an animal seen in a mirror, or as a person, is not solved") {
    auto [joints, truth] = drawn_animal();
    for (const char* joint : {"fore_foot", "fore_lower", "fore_upper", "hind_foot", "hind_lower", "hind_upper"})
        std::swap(joints[std::string("left_") + joint], joints[std::string("right_") + joint]);
    const MeshScore mirrored = score_joints(truth, joints);
    CHECK(mirrored.flipped.size() == 12);
    CHECK(mirrored.wrong_limbs.size() == 4);
    CHECK_FALSE(score_joints(truth, stick_body()).complete);
}

TEST_CASE("an animal's truth says so, and its skeleton's file has the tail's tip") {
    const TemporaryFolder folder;
    const auto [joints, truth] = drawn_animal();
    const fs::path truth_file = folder.path() / "truth.json", skeleton_file = folder.path() / "skeleton.json";
    write_truth(truth, truth_file);
    auto document = Json::parse(std::ifstream(truth_file));
    document["expect"] = "quadruped";
    std::ofstream(truth_file) << document;
    JointPositions without_tip = joints;
    without_tip.erase("tail_tip");
    write_skeleton_of(without_tip, skeleton_file);
    CHECK(evaluate_file(truth_file, skeleton_file).plan == BodyKind::quadruped);
    CHECK_FALSE(evaluate_file(truth_file, skeleton_file).limbs); // the last joint is too far from the tip
    document = Json::parse(std::ifstream(skeleton_file));
    document["end_points"] = {{"tail_tip", {0, 0.3, -0.36}}};
    std::ofstream(skeleton_file) << document;
    CHECK(evaluate_file(truth_file, skeleton_file).solved());
}

TEST_CASE("a folder without truth is refused") {
    const TemporaryFolder folder;
    CHECK_THROWS_AS(evaluate_folders(folder.path(), folder.path()), Error);
    CHECK_THROWS_AS(evaluate_folders(folder.path() / "absent", folder.path()), Error);
}

TEST_CASE("real truth, taken as the result, is solved with joints inside") {
    const auto bodies = test::bodies_folder();
    if (!bodies) SKELGEN_SKIP("SKELGEN_BODIES does not name the folder of real bodies");
    for (const std::string name : {"faust/tr_reg_000", "scape/mesh000", "psb/1"}) {
        const GroundTruth truth = read_ground_truth(*bodies / "truth" / (name + ".json"));
        JointPositions joints;
        for (const std::string& joint : evaluated_joints()) joints[joint] = Vector3<double>::Zero();
        for (const auto& [joint, position] : truth.markers) joints[joint] = position;
        for (const auto& [joint, position] : truth.joints) joints[joint] = position;
        const MeshScore score = score_joints(truth, joints);
        CAPTURE(name, score.wrong_limbs, score.flipped);
        CHECK(score.solved());
        for (const auto& [joint, error] : score.errors) CHECK(error == 0);
    }
}

TEST_CASE("what is no body is solved where no skeleton of it exists") {
    const TemporaryFolder folder;
    const fs::path truth = folder.path() / "truth", results = folder.path() / "results";
    write_truth(stick_truth(), truth / "set/body.json");
    write_skeleton_of(stick_body(), results / "set/body.json");
    for (const char* name : {"set/chair.json", "set/dog.json", "set/table.json"})
        std::ofstream(truth / name) << R"({"mesh": "x.off", "not_a_body": true})";
    write_skeleton_of(stick_body(), results / "set/dog.json");
    std::ofstream(results / "set/table.json") << "no skeleton, but a file";

    const std::vector<SetScore> sets = evaluate_folders(truth, results);
    REQUIRE(sets.size() == 1);
    REQUIRE(sets[0].meshes.size() == 4); // body, chair, dog, table
    CHECK(mesh_score_line("set", sets[0].meshes[1]) == "set/chair: solved, no body and no skeleton");
    CHECK(mesh_score_line("set", sets[0].meshes[2]) == "set/dog: FAILED, a skeleton of what is no body");
    CHECK_FALSE(sets[0].meshes[3].solved());

    const SetSummary summary = summarise(sets[0]);
    CHECK(summary.solved == 2);
    CHECK(summary.complete == 1);
    CHECK(summary.not_bodies == 3);
    CHECK(summary.refused == 1);
    REQUIRE(summary.errors);
    CHECK(summary.errors->count == 3); // the body's alone
    CHECK(summary_to_text(summary).find("no bodies 3, without a skeleton as they should be 1\n") != std::string::npos);
    const Json json = Json::parse(scores_to_json(sets, true))["set"];
    CHECK(json["refused"] == 1);
    CHECK(json["per_mesh"]["chair"]["refused"] == true);
    CHECK_FALSE(json["per_mesh"]["body"].contains("refused"));
}

TEST_CASE("a set of bodies says nothing of what is no body") {
    const SetSummary summary = summarise({"set", {score_joints(stick_truth(), stick_body())}});
    CHECK(summary.not_bodies == 0);
    CHECK(summary_to_text(summary).find("no bodies") == std::string::npos);
    GroundTruth none;
    none.not_a_body = true;
    CHECK_THROWS_AS(score_joints(none, stick_body()), Error);
}

} // namespace
