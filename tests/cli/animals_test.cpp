// What is made of an animal, as it is typed.

#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "json_schema.hpp"
#include "run_cli.hpp"

namespace {

using namespace skelgen::test;
namespace fs = std::filesystem;

/// The generated dog; nothing where no bodies are generated.
const std::string dog = SKELGEN_TEST_BODIES "/objects/dog.off";

std::string schema_faults_of(const fs::path& file, const std::string& schema) {
    return schema_faults(nlohmann::json::parse(read_file(file)), SKELGEN_DATA "/schema/" + schema + ".schema.json");
}

TEST_CASE("animals: each command takes --template quadruped, and without it says what it looked for", "[cli]") {
    if (!fs::exists(dog)) SKELGEN_SKIP("the generated bodies are not there");
    const TemporaryFolder folder;
    const auto run = [&](std::vector<std::string> arguments) {
        arguments.insert(arguments.end(), {"--template", "quadruped", "-q"});
        const CliResult result = run_cli(folder.path(), arguments);
        INFO(arguments.front() << ": " << result.err);
        CHECK(result.status == 0);
    };
    run({"segment", dog, "-o", "parts.json"});
    CHECK(schema_faults_of(folder / "parts.json", "segmentation").empty());
    CHECK(read_file(folder / "parts.json").find("left_hind_upper") != std::string::npos);
    run({"segment", dog, "-o", "parts.ply"});
    run({"measure", dog, "-o", "measures.json"});
    CHECK(schema_faults_of(folder / "measures.json", "measurements").empty());
    const auto measures = nlohmann::json::parse(read_file(folder / "measures.json"))["bodies"][0];
    CHECK(measures["height"].get<double>() > 0);
    CHECK_FALSE(measures.contains("arm_span"));
    run({"align", dog, "-o", "aligned"});
    CHECK(fs::exists(folder / "aligned/dog.off"));
    run({"pose", dog, "--like", dog, "-o", "posed.off"});
    run({"rig", dog, "-o", "rig.glb", "--names", "mesh2motion-fox"});
    CHECK(read_file(folder / "rig.glb").find("Front_Leg_Ankle_L") != std::string::npos);
    run({"correspond", dog, dog, "-o", "map.json"});
    CHECK(schema_faults_of(folder / "map.json", "correspondence").empty());

    const CliResult as_person = run_cli(folder.path(), {"segment", dog, "-o", "person.json"});
    CHECK(as_person.status == 4);
    CHECK(as_person.err.find("no human body") != std::string::npos);
    const std::string person = SKELGEN_DATA "/sample/body.off";
    const CliResult mixed = run_cli(folder.path(), {"correspond", person, dog, "--template", "auto", "-o", "map.json"});
    CHECK(mixed.status == 2);
    CHECK(mixed.err.find("a person and an animal") != std::string::npos);
    CHECK(run_cli(folder.path(), {"pose", person, "--like", dog, "--template", "auto", "-o", "posed.off"}).status == 2);
    const CliResult table = run_cli(folder.path(), {"measure", person, dog, "--template", "auto", "-q", "--csv"});
    CHECK(table.status == 2);
    CHECK(table.err.find("people and animals have not the same measures") != std::string::npos);
    const CliResult batch =
        run_cli(folder.path(), {"batch", dog, "-o", "out", "--template", "quadruped", "--also", "measure", "-q"});
    INFO(batch.err);
    CHECK(batch.status == 0);
    CHECK(run_cli(folder.path(), {"rig", dog, "--template", "bird", "-o", "rig.glb"}).status == 2);
}

} // namespace
