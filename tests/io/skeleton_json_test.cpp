#include <skelgen/io/skeleton_json.hpp>

#include <limits>

#include <nlohmann/json.hpp>

#include <skelgen/core/error.hpp>

#include "catch.hpp"
#include "json_schema.hpp"

namespace {

using namespace skelgen;
using namespace skelgen::io;
using Json = nlohmann::ordered_json;

template <typename Scalar>
KinematicSkeleton<Scalar> small_skeleton() {
    KinematicSkeleton<Scalar> skeleton;
    skeleton.template_name = "human21";
    skeleton.joints = {{"crotch", -1, {Scalar(0), Scalar(-0.0), Scalar(0.1)}, Scalar(0.11)},
                       {"waist", 0, {Scalar(1) / Scalar(3), Scalar(-2.5), Scalar(1e20)}, Scalar(0.13)}};
    skeleton.end_points = {{"head_top", {Scalar(0), Scalar(0), Scalar(0.8)}},
                           {"a_toe", {Scalar(1), Scalar(2), Scalar(3)}}};
    skeleton.frame.left = {Scalar(-1), Scalar(0), Scalar(0)};
    skeleton.joints[1].confidence = 0.5;
    skeleton.quality = {0.97, 7, {"the \"left\" foot is\nsmall"}, {{"foot", 1.5}, {"knee", -0.25}}};
    return skeleton;
}

SkeletonProvenance small_provenance() {
    return {SourceMesh{"mesh000.off", 12500, 24998, 2.31}, FileTimings{3.1, {2.5, 40.2, 0.4, 6.0, 0.10049, 50.0}}};
}

bool is_valid(const std::string& text) {
    return test::schema_faults(nlohmann::json::parse(text), SKELGEN_DATA "/schema/skeleton.schema.json").empty();
}

/// The message with which the reader refuses a document; fails the test if it does not.
std::string refusal(const std::string& text) {
    try {
        (void)parse_skeleton_document(text);
    } catch (const Error& error) {
        CHECK(error.code() == ErrorCode::bad_input);
        return error.what();
    }
    FAIL("was read: " << text);
    return {};
}

TEST_CASE("a skeleton file has the documented text") {
    const std::string expected = R"({
  "format": "skelgen-skeleton", "version": 1,
  "generator": {"name": "skelgen", "version": "VERSION"},
  "mesh": {"file": "mesh000.off", "vertices": 12500, "faces": 24998, "geodesic_diameter": 2.31},
  "template": "human21",
  "joints": [
    {"name": "crotch", "parent": null, "position": [0, 0, 0.1], "radius": 0.11, "confidence": 1},
    {"name": "waist", "parent": "crotch", "position": [0.3333333333333333, -2.5, 1e+20], "radius": 0.13, "confidence": 0.5}
  ],
  "end_points": {
    "head_top": [0, 0, 0.8],
    "a_toe": [1, 2, 3]
  },
  "frame": {"origin": [0, 0, 0], "left": [-1, 0, 0], "forward": [0, 1, 0], "up": [0, 0, 1]},
  "quality": {"sides_confidence": 0.97, "matched_nodes": 7, "warnings": ["the \"left\" foot is\nsmall"], "side_votes": {"foot": 1.5, "knee": -0.25}},
  "timings_ms": {"read": 3.1, "surface": 2.5, "curve": 40.2, "embed": 0.4, "refine": 6, "sides": 0.1, "total": 50}
}
)";
    std::string text = skeleton_to_json(small_skeleton<double>(), small_provenance());
    const std::string version = Json::parse(text)["generator"]["version"];
    text.replace(text.find(version), version.size(), "VERSION");
    CHECK(text == expected);
}

TEST_CASE("single precision numbers are as short as they can be") {
    const Json document = Json::parse(skeleton_to_json(small_skeleton<float>()));
    CHECK(document["joints"][0]["radius"].dump() == "0.11");
    CHECK(document["joints"][1]["position"].dump() == "[0.33333334,-2.5,1e+20]");
    CHECK(document["joints"][1]["position"][0].get<float>() == 1.0F / 3.0F);
}

TEST_CASE("a skeleton survives being written and read") {
    auto skeleton = small_skeleton<double>();
    skeleton.joints[1].position = {std::numeric_limits<double>::denorm_min(), std::numeric_limits<double>::max(),
                                   0.1 + 0.2};
    const std::string text = skeleton_to_json(skeleton, small_provenance());
    const SkeletonDocument read = parse_skeleton_document(text);

    CHECK(read.skeleton.template_name == "human21");
    REQUIRE(read.skeleton.joints.size() == 2);
    CHECK(read.skeleton.joints[0].parent == -1);
    CHECK(read.skeleton.joints[1].parent == 0);
    CHECK(read.skeleton.joints[1].position == skeleton.joints[1].position);
    CHECK(read.skeleton.end_points == skeleton.end_points);
    CHECK(read.skeleton.frame.left == skeleton.frame.left);
    CHECK(read.skeleton.quality.warnings == skeleton.quality.warnings);
    REQUIRE(read.skeleton.quality.side_votes.size() == 2);
    CHECK(read.skeleton.quality.side_votes[1].witness == "knee");
    CHECK(read.skeleton.quality.side_votes[1].strength == -0.25);
    CHECK(read.skeleton.joints[1].confidence == 0.5);
    CHECK(read.provenance.mesh.value().faces == 24998);
    CHECK(skeleton_to_json(read.skeleton, read.provenance) == text);
}

TEST_CASE("timings without those of the surface, as older files have them, are read") {
    Json older = Json::parse(skeleton_to_json(small_skeleton<double>(), small_provenance()));
    REQUIRE(older["timings_ms"].erase("surface") == 1);
    REQUIRE(is_valid(older.dump()));
    const auto timings = parse_skeleton_document(older.dump()).provenance.timings_ms;
    REQUIRE(timings);
    CHECK(timings->stages.surface == 0);
    CHECK(timings->stages.curve == 40.2);
}

TEST_CASE("a joint that is missing has no position, in the file and read again") {
    auto skeleton = small_skeleton<double>();
    skeleton.joints[1].is_present = false;
    skeleton.joints[1].confidence = 0;
    const std::string text = skeleton_to_json(skeleton);
    CHECK(text.find("{\"name\": \"waist\", \"parent\": \"crotch\", \"present\": false}") != std::string::npos);
    CHECK(is_valid(text));
    const KinematicSkeleton<double> read = parse_skeleton_document(text).skeleton;
    CHECK(read.joints[0].is_present);
    CHECK_FALSE(read.joints[1].is_present);
    CHECK(read.joints[1].position == read.joints[0].position); // where its limb ends
    CHECK(read.joints[1].confidence == 0);
    CHECK(skeleton_to_json(read) == text);
}

TEST_CASE("digits that are one say so, in the file and read again") {
    SkeletonProvenance provenance = small_provenance();
    provenance.fused = {{"waist", {"middle", "ring"}}};
    const std::string text = skeleton_to_json(small_skeleton<double>(), provenance);
    CHECK(is_valid(text));
    CHECK(Json::parse(text)["joints"][1]["fused"] == Json{"middle", "ring"});
    CHECK_FALSE(Json::parse(text)["joints"][0].contains("fused"));
    CHECK(parse_skeleton_document(text).provenance.fused == provenance.fused);
    Json broken = Json::parse(text);
    broken["joints"][1]["fused"] = "middle";
    CHECK_FALSE(is_valid(broken.dump()));
    CHECK(refusal(broken.dump()).find("\"fused\" of joint \"waist\" is no list") != std::string::npos);
}

TEST_CASE("a skeleton without a mesh leaves mesh and timings out") {
    const std::string text = skeleton_to_json(small_skeleton<double>());
    CHECK(text.find("\"mesh\"") == std::string::npos);
    CHECK(text.find("timings_ms") == std::string::npos);
    CHECK(is_valid(text));
    CHECK_FALSE(parse_skeleton_document(text).provenance.mesh.has_value());
}

TEST_CASE("a file name of any bytes gives UTF-8") {
    auto provenance = small_provenance();
    provenance.mesh->file = "a\xff\"\n\xc3\xa4.off";
    const std::string text = skeleton_to_json(small_skeleton<double>(), provenance);
    CHECK(is_valid(text));
    CHECK(parse_skeleton_document(text).provenance.mesh->file == "a\xef\xbf\xbd\"\n\xc3\xa4.off");
}

TEST_CASE("numbers that are not finite are never written") {
    auto skeleton = small_skeleton<double>();
    skeleton.joints[1].position.y() =
        GENERATE(std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity());
    try {
        (void)skeleton_to_json(skeleton);
        FAIL("was written");
    } catch (const Error& error) {
        CHECK(error.code() == ErrorCode::internal);
    }
}

TEST_CASE("files that are written fit the schema") {
    CHECK(is_valid(skeleton_to_json(small_skeleton<double>(), small_provenance())));
    CHECK(is_valid(skeleton_to_json(small_skeleton<float>(), small_provenance())));
}

TEST_CASE("broken files neither fit the schema nor are read") {
    const Json good = Json::parse(skeleton_to_json(small_skeleton<double>(), small_provenance()));
    Json bad = good;

    SECTION("a key is missing") {
        bad.erase(GENERATE("format", "version", "template", "joints", "end_points", "frame", "quality"));
    }
    SECTION("another format") { bad["format"] = "skelgen-curve"; }
    SECTION("another version") { bad["version"] = 2; }
    SECTION("no joints") { bad["joints"] = Json::array(); }
    SECTION("a joint without a name") { bad["joints"][0].erase("name"); }
    SECTION("a joint without a parent") { bad["joints"][1].erase("parent"); }
    SECTION("a position of two numbers") { bad["joints"][1]["position"] = {1, 2}; }
    SECTION("a position of text") { bad["joints"][1]["position"] = {"1", "2", "3"}; }
    SECTION("a joint without a position") { bad["joints"][1].erase("position"); }
    SECTION("a presence of text") { bad["joints"][1]["present"] = "no"; }
    SECTION("a radius of null") { bad["joints"][1]["radius"] = nullptr; }
    SECTION("an end point of one number") { bad["end_points"]["head_top"] = 1; }
    SECTION("a frame without up") { bad["frame"].erase("up"); }
    SECTION("nodes matched in part") { bad["quality"]["matched_nodes"] = 1.5; }
    SECTION("a warning that is no text") { bad["quality"]["warnings"][0] = 1; }
    SECTION("half a face") { bad["mesh"]["faces"] = 0.5; }
    SECTION("timings without total") { bad["timings_ms"].erase("total"); }

    REQUIRE(bad != good);
    CHECK_FALSE(is_valid(bad.dump()));
    CHECK_FALSE(refusal(bad.dump()).empty());
}

TEST_CASE("the reader says which part is wrong") {
    Json bad = Json::parse(skeleton_to_json(small_skeleton<double>()));
    SECTION("a parent that comes later") {
        std::swap(bad["joints"][0], bad["joints"][1]);
        CHECK(refusal(bad.dump()).find("the parent of joint \"waist\" does not come before it") != std::string::npos);
    }
    SECTION("two roots") {
        bad["joints"][1]["parent"] = nullptr;
        CHECK(refusal(bad.dump()).find("joint \"waist\" is a second root") != std::string::npos);
    }
    SECTION("a body without a root") {
        bad["joints"][0] = {{"name", "crotch"}, {"parent", nullptr}, {"present", false}};
        CHECK(refusal(bad.dump()).find("the root, is not present") != std::string::npos);
    }
    SECTION("a joint beyond a missing one") {
        bad["joints"].push_back(bad["joints"][1]);
        bad["joints"][2]["name"] = "chest";
        bad["joints"][2]["parent"] = "waist";
        bad["joints"][1] = {{"name", "waist"}, {"parent", "crotch"}, {"present", false}};
        CHECK(refusal(bad.dump()).find("joint \"chest\" is present, but its parent is not") != std::string::npos);
    }
    SECTION("a joint twice") {
        bad["joints"][1]["name"] = "crotch";
        CHECK(refusal(bad.dump()).find("joint \"crotch\" comes twice") != std::string::npos);
    }
    SECTION("no JSON") { CHECK(refusal("{\"format\": ").find("no valid JSON") != std::string::npos); }
    SECTION("another kind of JSON") { CHECK(refusal("[1, 2]").find("is no object") != std::string::npos); }
}

TEST_CASE("a file that is not there is said to be missing") {
    try {
        (void)read_skeleton("/nonexistent/skeleton.json");
        FAIL("was read");
    } catch (const Error& error) {
        CHECK(error.code() == ErrorCode::bad_input);
        CHECK(std::string(error.what()).find("No such file") != std::string::npos);
    }
}

} // namespace
