#include <skelgen/evaluation/reliability.hpp>

#include <fstream>

#include <nlohmann/json.hpp>

#include <skelgen/core/error.hpp>

#include "catch.hpp"
#include "temporary_folder.hpp"

using namespace skelgen;
using namespace skelgen::evaluation;

TEST_CASE("joints are counted in the interval of their confidence") {
    MeshScore mesh;
    mesh.errors = {{"a", 0.01}, {"b", 0.05}, {"c", 0.03}, {"d", 0.5}, {"unjudged", 0}};
    mesh.confidences = {{"a", 0.95}, {"b", 0.9}, {"c", 1.0}, {"d", 0.0}, {"of no truth", 0.5}};
    const auto bins = reliability({{"set", {mesh}}}, 5);
    REQUIRE(bins.size() == 5);
    CHECK(bins[4].from == Approx(0.8));
    CHECK(bins[4].to == Approx(1));
    CHECK(bins[4].joints == 3);
    CHECK(bins[4].near == 2); // 0.03 is near
    CHECK(bins[4].mean_confidence == Approx(0.95));
    CHECK(bins[0].joints == 1);
    CHECK(bins[0].near == 0);
    for (const std::size_t b : {1, 2, 3}) {
        CHECK(bins[b].joints == 0);
        CHECK(bins[b].mean_confidence == 0);
    }
    CHECK(reliability({{"set", {mesh}}}, 1, 1.0).front().near == 4);
    MeshScore odd; // a file may hold what is no confidence
    odd.errors = {{"a", 0}, {"b", 0}};
    odd.confidences = {{"a", 1e300}, {"b", -2}};
    const auto outermost = reliability({{"set", {odd}}}, 5);
    CHECK(outermost[4].joints == 1);
    CHECK(outermost[0].joints == 1);
    const auto json = nlohmann::json::parse(reliability_to_json(bins));
    REQUIRE(json.size() == 5);
    CHECK(json[4]["joints"] == 3);
    CHECK(json[4]["near"] == 2);
    CHECK(json[0]["from"] == 0.0);
}

TEST_CASE("there is a bin or more") {
    try {
        (void)reliability({}, 0);
        FAIL("accepted");
    } catch (const Error& error) {
        CHECK(error.code() == ErrorCode::usage);
    }
}

TEST_CASE("confidences are read from a skeleton file, as far as it has them") {
    const test::TemporaryFolder folder;
    std::ofstream(folder / "some.json") << R"({"joints": [{"name": "a", "confidence": 0.25, "position": [0, 0, 0]},
        {"name": "b", "position": [0, 0, 0]}, {"name": "c", "present": false, "confidence": 0}]})";
    std::ofstream(folder / "none.json") << "[1, 2]";
    CHECK(read_joint_confidences(folder / "some.json") == JointConfidences{{"a", 0.25}});
    CHECK(read_joint_confidences(folder / "none.json").empty());
    CHECK(read_joint_confidences(folder / "missing.json").empty());
}
