#include <algorithm>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include <skelgen/io/read_mesh.hpp>

#include "catch.hpp"
#include "run_cli.hpp"

namespace {

using namespace skelgen::test;
using Json = nlohmann::json;
namespace fs = std::filesystem;

Json summary_of(const fs::path& folder, const std::string& mesh) {
    std::istringstream text(read_file(folder / "summary.jsonl"));
    for (std::string line; std::getline(text, line);)
        if (const Json json = Json::parse(line); json.at("file") == mesh) return json;
    return {};
}

TEST_CASE("batch --also: further results in folders of their own, as the commands write them", "[cli][batch]") {
    const TemporaryFolder folder;
    fs::create_directories(folder / "in/set");
    fs::copy_file(sample_body, folder / "in/set/body.off");
    write_file(folder / "in/ball.off", sphere_off());
    const CliResult result =
        run_cli(folder.path(), {"batch", "in", "-o", "out", "--also", "rig,segment,measure,align,curve,rig", "--report",
                                "out/report.html"});
    INFO(result.err);
    CHECK(result.status == 5); // the ball is no body
    CHECK(files_below(folder / "out") ==
          std::vector<std::string>{"align/set/body.transform.json", "curve/set/body.curve.json",
                                   "measure/set/body.measurements.json", "render/ball.png", "render/set/body.png",
                                   "report.html", "rig/set/body.glb", "segment/set/body.segmentation.json",
                                   "set/body.json", "summary.jsonl"});
    const Json line = summary_of(folder / "out", "set/body.off");
    CHECK(line.at("status") == "ok");
    CHECK(line.at("also").size() == 6);
    for (const auto& [part, error] : line.at("also").items()) CHECK(error.is_null());
    CHECK(line.at("sides_confidence").get<double>() > 0.8);
    CHECK(line.at("least_confidence").get<double>() <= 1);

    const auto alone = [&](const std::vector<std::string>& arguments) {
        REQUIRE(run_cli(folder.path(), arguments).status == 0);
    };
    alone({"rig", "in/set/body.off", "-o", "rig.glb"});
    alone({"segment", "in/set/body.off", "-o", "parts.json"});
    alone({"curve", "in/set/body.off", "-o", "curve.json"});
    CHECK(read_file(folder / "out/rig/set/body.glb") == read_file(folder / "rig.glb"));
    CHECK(Json::parse(read_file(folder / "out/segment/set/body.segmentation.json")) ==
          Json::parse(read_file(folder / "parts.json")));
    CHECK(Json::parse(read_file(folder / "out/measure/set/body.measurements.json")).dump().find("height") !=
          std::string::npos);

    const std::string page = read_file(folder / "out/report.html");
    CHECK(page.find("<h2>ball.off</h2>") < page.find("<h2>set/body.off</h2>"));
    CHECK(page.find("no_skeleton") != std::string::npos);
    CHECK(std::count(page.begin(), page.end(), '\n') > 50);
    std::size_t pictures = 0;
    for (auto at = page.find("data:image/png"); at != std::string::npos; at = page.find("data:image/png", at + 1))
        ++pictures;
    CHECK(pictures == 2);

    // What is there is not done again; what has been taken away is; without --also no results of old are left.
    const auto again = [&](const std::vector<std::string>& more) {
        std::vector<std::string> arguments{"batch", "in/set", "-o", "out/set"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const CliResult run = run_cli(folder.path(), arguments);
        CHECK(run.status == 0);
        return run.err;
    };
    CHECK(again({"--also", "curve"}).find("1 done now") != std::string::npos);
    CHECK(again({"--also", "curve", "--resume"}).find("1 done before") != std::string::npos);
    CHECK(again({"--resume"}).find("1 done before") != std::string::npos);
    fs::remove(folder / "out/set/curve/body.curve.json");
    CHECK(again({"--also", "curve", "--resume"}).find("1 done now") != std::string::npos);
    CHECK(fs::exists(folder / "out/set/curve/body.curve.json"));
    again({});
    CHECK_FALSE(fs::exists(folder / "out/set/curve/body.curve.json"));
}

TEST_CASE("batch --also: a part that fails costs itself alone", "[cli][batch]") {
    const TemporaryFolder folder;
    write_file(folder / "out/align/body.transform.json/in/the/way", "");
    const CliResult result = run_cli(folder.path(), {"batch", sample_body, "-o", "out", "--also", "align,curve"});
    INFO(result.err);
    CHECK(result.status == 5);
    CHECK(result.err.find("skelgen: error: out/align/body.transform.json: ") != std::string::npos);
    CHECK(result.err.find("1 done now, 0 done before, 0 failed, 1 further results failed") != std::string::npos);
    CHECK(fs::exists(folder / "out/body.json"));
    CHECK(fs::exists(folder / "out/curve/body.curve.json"));
    const Json line = summary_of(folder / "out", "body.off");
    CHECK(line.at("status") == "ok");
    CHECK(line.at("also").at("curve").is_null());
    CHECK(line.at("also").at("align").get<std::string>().find("out/align/body.transform.json: ") == 0);
}

TEST_CASE("batch --also and --report: what would replace a mesh or another result is refused", "[cli][batch]") {
    const TemporaryFolder folder;
    write_file(folder / "in/rig/a.glb", "x");
    write_file(folder / "in/a.off", "x");
    write_file(folder / "in/b.off", "x");
    write_file(folder / "in/curve/b.curve.off", "x");
    const auto files = files_below(folder.path());
    const auto fails = [&](const std::vector<std::string>& more, const std::string& reason) {
        std::vector<std::string> arguments{"batch", "in", "-q"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const CliResult result = run_cli(folder.path(), arguments);
        INFO(result.err);
        CHECK(result.status == 2);
        CHECK(result.err.rfind("skelgen: error: " + reason, 0) == 0);
        CHECK(files_below(folder.path()) == files);
    };
    fails({"-o", "in", "--also", "rig"}, "in/rig/a.glb: is a mesh that --also rig would replace");
    fails({"-o", "out", "--also", "curve"}, "out/curve/b.curve.json: would be written twice");
    fails({"-o", "out", "--also", "rig,pose"}, "--also: 'pose' is none of rig, segment, measure, align, curve");
    fails({"-o", "out", "--also", ","}, "--also: '' is none of");
    fails({"-o", "out", "--report", "in/b.off"}, "in/b.off: is the input");
    fails({"-o", "out", "--report", "out/b.json"}, "out/b.json: is a result of the batch");
    fails({"-o", "out", "--also", "align", "--report", "out/../out/align/a.transform.json"},
          "out/../out/align/a.transform.json: is a result of the batch");
    fails({"-o", "out", "--report", "out/summary.jsonl"}, "out/summary.jsonl: is a result of the batch");
    fails({"-o", "out", "--csv", "in/b.off"}, "in/b.off: is the input");
    fails({"-o", "out", "--npz", "out/b.json"}, "out/b.json: is a result of the batch");
    fails({"-o", "out", "--csv", "t", "--npz", "./t"}, "./t: is a result of the batch");
    fails({"-o", "out", "--also", "correspond"}, "--also correspond: name the body");
    fails({"-o", "out", "--template-body", sample_body}, "--template-body: goes with --also correspond");
    // Before the work and not after it.
    fails({"-o", "out", "--csv", "no/such/t.csv"}, "no/such/t.csv: cannot be written: its folder does not exist");
    fails({"-o", "out", "--report", "no/such/report.html"},
          "no/such/report.html: cannot be written: its folder does not exist");
}

TEST_CASE("batch --also correspond: each mesh beside one template body", "[cli][batch]") {
    const TemporaryFolder folder;
    fs::create_directories(folder / "in");
    fs::copy_file(sample_body, folder / "in/body.off");
    fs::copy_file(sample_body, folder / "template.off");
    const auto batch = [&](const std::vector<std::string>& more) {
        std::vector<std::string> arguments{"batch",           "in",          "-o", "out", "--also", "correspond",
                                           "--template-body", "template.off"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run_cli(folder.path(), arguments);
    };
    const CliResult result = batch({});
    INFO(result.err);
    REQUIRE(result.status == 0);
    REQUIRE(run_cli(folder.path(),
                    {"correspond", "template.off", "in/body.off", "-o", "alone.json", "--confidence", "--places"})
                .status == 0);
    CHECK(read_file(folder / "out/correspond/body.correspondence.json") == read_file(folder / "alone.json"));

    CHECK(batch({"--resume"}).err.find("1 done before") != std::string::npos);
    const std::string text = read_file(folder / "template.off");
    write_file(folder / "template.off", "OFF # another file of the same body" + text.substr(3));
    CHECK(batch({"--resume"}).err.find("1 done now") != std::string::npos);
    write_file(folder / "template.off", sphere_off());
    const CliResult refused = batch({});
    CHECK(refused.status == 4);
    CHECK(refused.err.rfind("skelgen: error: template.off: ", 0) == 0);
}

TEST_CASE("batch --csv and --npz: a row for each mesh, done now or before", "[cli][batch]") {
    const TemporaryFolder folder;
    fs::create_directories(folder / "in");
    fs::copy_file(sample_body, folder / "in/body.off");
    write_file(folder / "in/to\"rn.off", "OFF\n1");
    const CliResult first = run_cli(folder.path(), {"batch", "in", "-o", "out", "--csv", "bodies.csv"});
    INFO(first.err);
    CHECK(first.status == 5);
    const auto rows_of = [](const std::string& csv) {
        std::vector<std::string> rows;
        std::istringstream text(csv);
        for (std::string row; std::getline(text, row);) rows.push_back(row);
        return rows;
    };
    const std::vector<std::string> rows = rows_of(read_file(folder / "bodies.csv"));
    REQUIRE(rows.size() == 3);
    CHECK(rows[0].rfind("file,status,error,seconds,sides_confidence,crotch_x,crotch_y,crotch_z,crotch_confidence,",
                        0) == 0);
    CHECK(rows[0].find(",height,") != std::string::npos);
    CHECK(rows[0].find(",girth_waist,") != std::string::npos);
    const auto cells = std::count(rows[0].begin(), rows[0].end(), ',');
    CHECK(std::count(rows[1].begin(), rows[1].end(), ',') == cells);
    CHECK(rows[1].rfind("\"body.off\",ok,,", 0) == 0);
    CHECK(rows[1].find(",m\r") == rows[1].size() - 3);
    CHECK(rows[2].rfind("\"to\"\"rn.off\",bad_input,\"in/to\"\"rn.off: ", 0) == 0);
    const Json skeleton = Json::parse(read_file(folder / "out/body.json"));
    std::istringstream cell(rows[1]);
    std::string text;
    for (int i = 0; i < 6; ++i) REQUIRE(std::getline(cell, text, ','));
    CHECK(std::stod(text) == skeleton.at("joints").at(0).at("position").at(0).get<double>());

    // What was done before is in the table, too; on standard output where that is wanted.
    const CliResult again = run_cli(folder.path(), {"batch", "in", "-o", "out", "--resume", "--csv", "-"});
    CHECK(again.err.find("1 done before") != std::string::npos);
    REQUIRE(rows_of(again.out).size() == 3);
    CHECK(rows_of(again.out)[1] == rows[1]);

    REQUIRE(run_cli(folder.path(), {"batch", "in/body.off", "-o", "out", "--resume", "--npz", "a.npz"}).status == 0);
    REQUIRE(run_cli(folder.path(), {"batch", "in/body.off", "-o", "out", "--resume", "--npz", "b.npz"}).status == 0);
    CHECK(read_file(folder / "a.npz").rfind("PK\x03\x04", 0) == 0);
    CHECK(read_file(folder / "a.npz") == read_file(folder / "b.npz"));
}

} // namespace
