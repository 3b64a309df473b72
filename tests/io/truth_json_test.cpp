#include <fstream>
#include <string>

#include <skelgen/core/error.hpp>
#include <skelgen/io/truth_json.hpp>

#include "catch.hpp"
#include "temporary_folder.hpp"

using namespace skelgen;
using namespace skelgen::io;
using namespace skelgen::test;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

/// The message with which reading `text` as a truth file is refused; empty when it is not.
template <typename Read>
std::string refusal(const std::string& text, const Read& read) {
    const TemporaryFolder folder;
    std::ofstream(folder / "truth.json") << text;
    try {
        (void)read(folder / "truth.json");
    } catch (const Error& error) {
        CHECK(error.code() == ErrorCode::bad_input);
        return error.what();
    }
    return {};
}

} // namespace

TEST_CASE("a truth file's joints come in its order, its markers by name", "[io][truth]") {
    const TemporaryFolder folder;
    std::ofstream(folder / "truth.json")
        << R"({"mesh": "a.off", "scale": 2, "joints": {"neck": [1, 2, 3], "crotch": [0, 0, 0.5]},
               "markers": {"head": [4, 5, 6]}})";
    const GroundTruth truth = read_ground_truth(folder / "truth.json");
    CHECK(truth.scale == 2);
    CHECK_FALSE(truth.not_a_body);
    CHECK(truth.joints == NamedPoints{{"neck", {1, 2, 3}}, {"crotch", {0, 0, 0.5}}});
    CHECK(truth.markers.at("head") == Vector3<double>(4, 5, 6));
    CHECK(read_true_joints(folder / "truth.json") == truth.joints);
    CHECK(truth.missing.empty());
}

TEST_CASE("a truth file says which joints the body lacks", "[io][truth]") {
    const TemporaryFolder folder;
    std::ofstream(folder / "truth.json")
        << R"({"scale": 1, "joints": {}, "markers": {}, "missing": ["left_hand", "left_wrist"]})";
    CHECK(read_ground_truth(folder / "truth.json").missing == std::set<std::string>{"left_hand", "left_wrist"});
}

TEST_CASE("the truth of what is no body has nothing else", "[io][truth]") {
    const TemporaryFolder folder;
    std::ofstream(folder / "truth.json") << R"({"mesh": "a.off", "not_a_body": true})";
    CHECK(read_ground_truth(folder / "truth.json").not_a_body);
    CHECK(read_ground_truth(folder / "truth.json").joints.empty());
}

TEST_CASE("what a truth file lacks is named", "[io][truth]") {
    const auto whole = [](const fs::path& file) { return read_ground_truth(file); };
    CHECK_THAT(refusal("", whole), Contains("no valid JSON"));
    CHECK_THAT(refusal("[]", whole), Contains("\"joints\" is missing"));
    CHECK_THAT(refusal(R"({"joints": {}})", whole), Contains("\"markers\" is missing"));
    CHECK_THAT(refusal(R"({"joints": {}, "markers": {}})", whole), Contains("\"scale\" is missing"));
    CHECK_THAT(refusal(R"({"scale": -1, "joints": {}, "markers": {}})", whole), Contains("not above zero"));
    CHECK_THAT(refusal(R"({"scale": 1, "joints": {}, "markers": {}, "missing": "head"})", whole), Contains("no list"));
    CHECK_THAT(refusal(R"({"scale": 1, "joints": {}, "markers": {}, "missing": [1]})", whole), Contains("no name"));
    CHECK_THAT(refusal(R"({"scale": 1, "joints": {"neck": [1, 2]}, "markers": {}})", whole), Contains("\"neck\""));

    const auto joints = [](const fs::path& file) { return read_true_joints(file); };
    CHECK(refusal(R"({"joints": {"neck": [1, 2, 3]}})", joints).empty());
    CHECK_THAT(refusal(R"({"joints": {"neck": [1, 2, "3"]}})", joints), Contains("\"neck\""));
    CHECK_THAT(refusal(R"({"joints": [1]})", joints), Contains("\"joints\" is missing"));
}
