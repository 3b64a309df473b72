#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "run_cli.hpp"

namespace {

using namespace skelgen::test;
using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

/// A truth file and a skeleton file with the same 21 joints, the neck moved by a hundredth of the scale.
void write_case(const fs::path& truth_file, const fs::path& skeleton_file) {
    Json truth{{"scale", 2}, {"joints", {{"neck", {0.1, 0.0, 1.5}}}}, {"markers", Json::object()}};
    Json skeleton{{"joints", Json::array()}};
    double height = 1;
    const auto add = [&](const std::string& name, double x) {
        truth["markers"][name] = {x, 0.0, height};
        skeleton["joints"].push_back({{"name", name}, {"position", {x, 0.0, height}}});
    };
    for (const char* name : {"crotch", "waist", "chest", "head"}) add(name, 0);
    for (const std::string name : {"shoulder", "elbow", "wrist", "hand", "hip", "knee", "ankle", "foot"}) {
        height += 0.3;
        add("left_" + name, 0.5);
        add("right_" + name, -0.5);
    }
    skeleton["joints"].push_back({{"name", "neck"}, {"position", {0.1, 0.02, 1.5}}});
    write_file(truth_file, truth.dump());
    write_file(skeleton_file, skeleton.dump());
}

TEST_CASE("two files are compared") {
    const TemporaryFolder folder;
    write_case(folder / "truth.json", folder / "skeleton.json");
    const CliResult result = run_cli(folder.path(), {"evaluate", "truth.json", "skeleton.json", "--per-mesh"});
    CHECK(result.status == 0);
    CHECK(result.out.find("solved 1/1 (complete 1, limbs right 1, sides right 1)") != std::string::npos);
    CHECK(result.out.find("neck            0.0100  0.0100  0.0100  0.0100  truth\n") != std::string::npos);
    CHECK(result.err.empty());
}

TEST_CASE("a finger and a toe of both files have rows, and a row of all digits") {
    const TemporaryFolder folder;
    write_case(folder / "truth.json", folder / "skeleton.json");
    Json truth = Json::parse(read_file(folder / "truth.json")),
         skeleton = Json::parse(read_file(folder / "skeleton.json"));
    for (const auto& [kind, joint] : {std::pair{"fingers", "left_index_1"}, std::pair{"toes", "left_toe1_1"}}) {
        truth[kind][joint] = {0, 0, 0};
        skeleton["joints"].push_back({{"name", joint}, {"position", {0, 0, 0.1}}});
    }
    skeleton["joints"].push_back({{"name", "left_toe1_2"}, {"present", false}});
    write_file(folder / "truth.json", truth.dump());
    write_file(folder / "skeleton.json", skeleton.dump());
    const CliResult result = run_cli(folder.path(), {"evaluate", "truth.json", "skeleton.json"});
    CHECK(result.status == 0);
    const std::size_t rows = result.out.find("\n  all             0.0100");
    REQUIRE(rows != std::string::npos);
    for (const char* joint : {"left_index_1  ", "left_toe1_1   ", "all digits    "})
        CHECK(result.out.find(std::string("\n  ") + joint + "  0.0500", rows) != std::string::npos);
    CHECK(result.out.find("left_toe1_2") == std::string::npos);
}

TEST_CASE("the truth of what is no body wants no skeleton file") {
    const TemporaryFolder folder;
    write_file(folder / "truth.json", R"({"not_a_body": true})");
    const CliResult none = run_cli(folder.path(), {"evaluate", "truth.json", "skeleton.json"});
    CHECK(none.status == 0);
    CHECK(none.out.find("truth: solved 1/1") == 0);
    write_file(folder / "skeleton.json", "{}");
    const CliResult found = run_cli(folder.path(), {"evaluate", "truth.json", "skeleton.json"});
    CHECK(found.out.find("truth: solved 0/1") == 0);
}

TEST_CASE("two folders are compared, to text, CSV and JSON") {
    const TemporaryFolder folder;
    write_case(folder / "truth/set/a.json", folder / "results/set/a.json");
    SECTION("text") {
        const CliResult result = run_cli(folder.path(), {"evaluate", "truth", "results"});
        CHECK(result.out.find("set: solved 1/1") == 0);
    }
    SECTION("CSV to standard output") {
        const CliResult result = run_cli(folder.path(), {"evaluate", "truth", "results", "--csv"});
        CHECK(result.out == "set,joint,count,mean,median,p95,worst,worst_mesh\nset,neck,1,0.01,0.01,0.01,0.01,a\n"
                            "set,all,1,0.01,0.01,0.01,0.01,a\n");
    }
    SECTION("reliability to a picture or JSON, and the text too") {
        const CliResult picture = run_cli(folder.path(), {"evaluate", "truth", "results", "--reliability", "plot.png"});
        CHECK(picture.status == 0);
        CHECK(picture.out.find("set: solved 1/1") == 0);
        CHECK(read_file(folder / "plot.png").substr(1, 3) == "PNG");
        CHECK(run_cli(folder.path(), {"evaluate", "truth", "results", "--reliability", "plot.json"}).status == 0);
        CHECK(read_file(folder / "plot.json").find("\"mean_confidence\"") != std::string::npos);
        const CliResult alone = run_cli(folder.path(), {"evaluate", "truth", "results", "--reliability", "-"});
        CHECK(alone.status == 0);
        CHECK(alone.out == read_file(folder / "plot.json")); // and no text after it
        for (const std::vector<std::string>& more : {std::vector<std::string>{"--reliability", "-", "--json", "-"},
                                                     std::vector<std::string>{"--reliability", "x", "--json", "x"}}) {
            std::vector<std::string> arguments{"evaluate", "truth", "results"};
            arguments.insert(arguments.end(), more.begin(), more.end());
            CHECK(run_cli(folder.path(), arguments).status == 2);
        }
        CHECK_FALSE(fs::exists(folder / "x"));
    }
    SECTION("CSV to a file, and the text too") {
        const CliResult result = run_cli(folder.path(), {"evaluate", "truth", "results", "--csv", "table.csv"});
        CHECK(result.out.find("set: solved 1/1") == 0);
        CHECK(read_file(folder / "table.csv").find("\nset,neck,1,0.01,") != std::string::npos);
    }
    SECTION("JSON to standard output") {
        const CliResult result = run_cli(folder.path(), {"evaluate", "truth", "results", "--json", "-"});
        CHECK(Json::parse(result.out)["set"]["mean_error"] == 0.01);
    }
}

TEST_CASE("what cannot be compared is said in one line") {
    const TemporaryFolder folder;
    write_case(folder / "truth/set/a.json", folder / "results/set/a.json");
    std::vector<std::string> arguments;
    int status = 3;
    SECTION("no truth") { arguments = {"absent", "results"}; }
    SECTION("no results") { arguments = {"truth", "absent"}; }
    SECTION("no meshes") { arguments = {"truth", "results", "--meshes", "absent"}; }
    SECTION("a folder and a file") {
        arguments = {"truth", "results/set/a.json"};
        status = 2;
    }
    arguments.insert(arguments.begin(), "evaluate");
    const CliResult result = run_cli(folder.path(), arguments);
    CHECK(result.status == status);
    CHECK(result.err.find("skelgen: error: ") == 0);
    CHECK(result.err.find('\n') == result.err.size() - 1);
    CHECK(result.out.empty());
}

} // namespace
