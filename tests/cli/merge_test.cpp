#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <sys/stat.h>
#include <vector>

#include <nlohmann/json.hpp>

#include "batch_results.hpp"
#include "catch.hpp"
#include "run_cli.hpp"

namespace {

using namespace skelgen::test;
using Json = nlohmann::json;
namespace fs = std::filesystem;
using Statuses = std::map<std::string, std::string>;

/// A batch of the bodies in/a.off and in/b.off, done in the shards s1 (a) and s2 (b).
struct TwoShards {
    TemporaryFolder folder;

    explicit TwoShards(const std::vector<std::string>& more = {}) {
        write_file(folder / "in/a.off", read_file(sample_body));
        write_file(folder / "in/b.off", read_file(sample_body));
        for (const char* number : {"1", "2"}) {
            std::vector<std::string> arguments{
                "batch", "in", "-q", "-o", std::string("s") + number, "--shard", std::string(number) + "/2"};
            arguments.insert(arguments.end(), more.begin(), more.end());
            REQUIRE(run_cli(folder.path(), arguments).status == 0);
        }
    }

    [[nodiscard]] CliResult merge(std::vector<std::string> shards, const std::string& out = "out") const {
        shards.insert(shards.begin(), "merge");
        shards.insert(shards.end(), {"--meshes", "in", "-o", out});
        return run_cli(folder.path(), shards);
    }
};

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST_CASE("shards merged are what one batch writes, failures and further results included", "[cli][merge]") {
    const TemporaryFolder folder;
    for (const char* file : {"in/a.off", "in/deep/b.off"}) write_file(folder / file, read_file(sample_body));
    write_file(folder / "in/empty.off", "");
    write_file(folder / "in/sphere.off", sphere_off());
    const auto batch = [&](const std::string& out, const std::string& shard) {
        return run_cli(folder.path(),
                       {"batch", "in", "-o", out, "--shard", shard, "--also", "measure,render", "--jobs", "2"});
    };
    REQUIRE(batch("whole", "1/1").status == 5);
    for (const char* number : {"1", "2", "3"})
        static_cast<void>(batch("shards/" + std::string(number), number + std::string("/3")));
    const CliResult result = run_cli(folder.path(), {"merge", "shards/1", "shards/2", "shards/3", "shards/2/",
                                                     "--meshes", "in", "-o", "merged", "--report", "report.html"});
    CHECK(result.status == 5);
    CHECK(result.out.empty());
    CHECK(holds(result.err, "skelgen: error: in/empty.off: "));
    CHECK(holds(result.err, "4 meshes in 3 shards: 2 done, 2 failed, 0 missing, 0 contradictory, 0 done twice"));
    CHECK(results(folder / "merged") == results(folder / "whole"));
    const std::string page = read_file(folder / "report.html");
    for (const char* file : {"a.off", "deep/b.off", "empty.off", "sphere.off"})
        CHECK(holds(page, std::string("<h2>") + file + "</h2>"));
    CHECK(holds(page, "data:image/png;base64,"));
    CHECK(fs::hard_link_count(folder / "merged/a.json") == 2); // no copy
}

TEST_CASE("what no shard tells of is missing, and a batch in the merged folder does that alone", "[cli][merge]") {
    const TwoShards batch;
    const CliResult result = batch.merge({"s1"});
    CHECK(result.status == 5);
    CHECK(holds(result.err, "skelgen: error: in/b.off: is in no shard's summary"));
    CHECK(statuses(batch.folder / "out") == Statuses{{"a.off", "ok"}, {"b.off", "missing"}});
    CHECK(files_below(batch.folder / "out") == std::vector<std::string>{"a.json", "summary.jsonl"});
    const CliResult rest = run_cli(batch.folder.path(), {"batch", "in", "-o", "out", "--resume"});
    CHECK(rest.status == 0);
    CHECK(holds(rest.err, "2 meshes: 1 done now, 1 done before, 0 failed"));
}

TEST_CASE("a merge starts over, and merges can be merged", "[cli][merge]") {
    const TwoShards batch;
    CHECK(batch.merge({"s1", "s2"}).status == 0);
    CHECK(batch.merge({"s1"}).status == 5);
    CHECK_FALSE(fs::exists(batch.folder / "out/b.json"));
    CHECK(batch.merge({"s2"}, "other").status == 5);
    const CliResult both = batch.merge({"out", "other"}, "both");
    CHECK(both.status == 0);
    CHECK(holds(both.err, "2 done, 0 failed, 0 missing, 0 contradictory, 0 done twice"));
}

TEST_CASE("a skeleton that is not there as its line says is missing", "[cli][merge]") {
    const TwoShards batch;
    const fs::path skeleton = batch.folder / "s1/a.json";
    SECTION("gone") { fs::remove(skeleton); }
    SECTION("cut off") { fs::resize_file(skeleton, fs::file_size(skeleton) / 2); }
    SECTION("another one") {
        std::string text = read_file(skeleton);
        text.replace(text.find("\"radius\": 0."), 12, "\"radius\": 1.");
        write_file(skeleton, text);
    }
    SECTION("a folder") {
        fs::remove(skeleton);
        fs::create_directory(skeleton);
    }
    const CliResult result = batch.merge({"s1", "s2"});
    CHECK(result.status == 5);
    CHECK(holds(result.err, "skelgen: error: in/a.off: its skeleton in s1 is not there as it was written"));
    CHECK(statuses(batch.folder / "out") == Statuses{{"a.off", "missing"}, {"b.off", "ok"}});
    CHECK_FALSE(fs::exists(batch.folder / "out/a.json"));
}

TEST_CASE("a further result that is gone is a failure", "[cli][merge]") {
    const TwoShards batch({"--also", "measure"});
    fs::remove(batch.folder / "s1/measure/a.measurements.json");
    const CliResult result = batch.merge({"s1", "s2"});
    CHECK(result.status == 5);
    CHECK(holds(result.err, "skelgen: error: s1/measure/a.measurements.json: is not there any more"));
    CHECK(files_below(batch.folder / "out") ==
          std::vector<std::string>{"a.json", "b.json", "measure/b.measurements.json", "summary.jsonl"});
}

TEST_CASE("what is done twice with one result is named and taken once", "[cli][merge]") {
    const TwoShards batch;
    SECTION("by two shards") { fs::copy(batch.folder / "s1", batch.folder / "s3"); }
    SECTION("by one of them, in two runs at a time") {
        const std::string line = read_file(batch.folder / "s2/summary.jsonl");
        write_file(batch.folder / "s2/summary.jsonl", line + line);
        fs::create_directory(batch.folder / "s3");
        write_file(batch.folder / "s3/summary.jsonl", ""); // a shard without meshes
    }
    const CliResult result = batch.merge({"s1", "s2", "s3"});
    CHECK(result.status == 0);
    CHECK(holds(result.err, "skelgen: warning: "));
    CHECK(holds(result.err, "is in several lines of the summaries, of s"));
    CHECK(holds(result.err, "2 done, 0 failed, 0 missing, 0 contradictory, 1 done twice"));
    CHECK(statuses(batch.folder / "out") == Statuses{{"a.off", "ok"}, {"b.off", "ok"}});
}

TEST_CASE("a skeleton goes before a failure of another shard", "[cli][merge]") {
    const TwoShards batch;
    fs::create_directory(batch.folder / "s0");
    Json line = read_summary(batch.folder / "s1").at("a.off");
    line["status"] = "timeout";
    line["error"] = "in/a.off: took longer than 1 s";
    write_file(batch.folder / "s0/summary.jsonl", line.dump() + "\n");
    CHECK(batch.merge({"s0", "s1", "s2"}).status == 0);
    CHECK(statuses(batch.folder / "out") == Statuses{{"a.off", "ok"}, {"b.off", "ok"}});
}

TEST_CASE("skeletons that differ between shards are left out", "[cli][merge]") {
    const TwoShards batch;
    const CliResult scaled =
        run_shell(batch.folder.path(), "mkdir other && awk 'NR>2 && NF==3 {print $1*2,$2*2,$3*2; next} "
                                       "{print}' in/a.off >other/a.off");
    REQUIRE(scaled.status == 0);
    REQUIRE(run_cli(batch.folder.path(), {"batch", "other", "-o", "s3"}).status == 0);
    const CliResult result = batch.merge({"s1", "s2", "s3"});
    CHECK(result.status == 5);
    CHECK(holds(result.err, "skelgen: error: in/a.off: its skeletons in s1 and s3 differ"));
    CHECK(statuses(batch.folder / "out") == Statuses{{"a.off", "contradiction"}, {"b.off", "ok"}});
    CHECK_FALSE(fs::exists(batch.folder / "out/a.json"));
}

TEST_CASE("shards of another run are refused", "[cli][merge]") {
    const TwoShards batch;
    SECTION("of other meshes") {
        write_file(batch.folder / "other/z.off", "");
        REQUIRE(run_cli(batch.folder.path(), {"batch", "other", "-o", "s3"}).status == 5);
        const CliResult result = batch.merge({"s1", "s2", "s3"});
        CHECK(result.status == 3);
        CHECK(holds(result.err, "skelgen: error: s3: tells of none of these meshes but of others, such as z.off"));
    }
    SECTION("with another template") {
        REQUIRE(run_cli(batch.folder.path(), {"batch", "in", "-o", "s2", "--shard", "2/2", "--template", "pinocchio18"})
                    .status == 0);
        const CliResult result = batch.merge({"s1", "s2"});
        CHECK(result.status == 3);
        CHECK(holds(result.err, "skelgen: error: s2: has skeletons of the template pinocchio18, s1 of human21"));
    }
    CHECK_FALSE(fs::exists(batch.folder / "out"));
}

TEST_CASE("lines of meshes that are not asked for are named", "[cli][merge]") {
    const TwoShards batch;
    std::string text = read_file(batch.folder / "s1/summary.jsonl");
    Json line = read_summary(batch.folder / "s1").at("a.off");
    line["file"] = "../../elsewhere.off";
    write_file(batch.folder / "s1/summary.jsonl", text + line.dump() + "\n");
    const CliResult result = batch.merge({"s1", "s2"});
    CHECK(result.status == 5);
    CHECK(holds(result.err, "skelgen: error: s1: ../../elsewhere.off: is none of these meshes"));
    CHECK(statuses(batch.folder / "out") == Statuses{{"a.off", "ok"}, {"b.off", "ok"}});
}

TEST_CASE("lines that cannot be read are counted, and cost their own meshes alone", "[cli][merge]") {
    const TwoShards batch;
    const fs::path summary = batch.folder / "s1/summary.jsonl";
    const std::string line = read_file(summary);
    const std::string junk = GENERATE(as<std::string>(), "", "{}\n", "[1, 2]\n", "null\n", "\n", "{\"file\": 3}\n",
                                      "\xff\xfe\n", std::string(100000, '['),
                                      "{\"file\":\"a.off\",\"status\":\"ok\",\"error\":null,\"seconds\":1e999,"
                                      "\"faces\":0,\"warnings\":[]}\n",
                                      "{\"file\":\"a.off\",\"status\":\"ok\",\"error\":null,\"seconds\":0,"
                                      "\"faces\":1e300,\"warnings\":[]}\n");
    write_file(summary, junk);
    const CliResult result = batch.merge({"s1", "s2"});
    CHECK(result.status == 5);
    CHECK(holds(result.err, "warning: s1/summary.jsonl: 1 of its lines cannot be read") == !junk.empty());
    CHECK(statuses(batch.folder / "out") == Statuses{{"a.off", "missing"}, {"b.off", "ok"}});
    write_file(summary, junk + (junk.ends_with('\n') ? "" : "\n") + line + line.substr(0, line.size() / 2));
    CHECK(batch.merge({"s1", "s2"}).status == 0);
}

TEST_CASE("a line may say of further results what it likes", "[cli][merge]") {
    const TwoShards batch;
    Json line = read_summary(batch.folder / "s1").at("a.off");
    line["also"] = {{"../../x", nullptr}, {"", nullptr}, {"curve", "did not work"}};
    write_file(batch.folder / "s1/summary.jsonl", line.dump() + "\n");
    const CliResult result = batch.merge({"s1", "s2"});
    CHECK(result.status == 5);
    CHECK(holds(result.err, "skelgen: error: did not work\n"));
    CHECK(files_below(batch.folder / "out") == std::vector<std::string>{"a.json", "b.json", "summary.jsonl"});
}

TEST_CASE("what is missing is named up to a number, and counted beyond", "[cli][merge]") {
    const TemporaryFolder folder;
    for (int i = 0; i < 30; ++i) write_file(folder / ("in/" + std::to_string(i) + ".off"), "");
    write_file(folder / "s1/summary.jsonl", "");
    const CliResult result = run_cli(folder.path(), {"merge", "s1", "--meshes", "in", "-o", "out"});
    CHECK(result.status == 5);
    CHECK(std::count(result.err.begin(), result.err.end(), '\n') == 22);
    CHECK(holds(result.err, "skelgen: error: 10 more of this kind; all are in out/summary.jsonl"));
    CHECK(read_summary(folder / "out").size() == 30);
}

TEST_CASE("what cannot be merged is refused before anything is written", "[cli][merge]") {
    const TemporaryFolder folder;
    write_file(folder / "in/a.off", "");
    REQUIRE(run_cli(folder.path(), {"batch", "in", "-o", "s1"}).status == 5);
    const auto merge = [&](const std::vector<std::string>& arguments) {
        std::vector<std::string> all{"merge"};
        all.insert(all.end(), arguments.begin(), arguments.end());
        return run_cli(folder.path(), all);
    };
    CHECK(merge({"s1", "-o", "out"}).status == 2);
    CHECK(merge({"--meshes", "in", "-o", "out"}).status == 2);
    CHECK(merge({"s1", "--meshes", "in", "-o", "./s1/"}).status == 2);
    CHECK(merge({"nowhere", "--meshes", "in", "-o", "out"}).status == 3);
    CHECK(merge({"in", "--meshes", "in", "-o", "out"}).status == 3);
    CHECK(merge({"s1", "--meshes", "nothing*", "-o", "out"}).status == 3);
    CHECK(merge({"s1", "--meshes", "in", "-o", "out", "--report", "in/a.off"}).status == 2);
    fs::create_directories(folder / "s2/summary.jsonl");
    CHECK(merge({"s2", "--meshes", "in", "-o", "out"}).status == 3);
    fs::create_directory(folder / "s3");
    REQUIRE(::mkfifo((folder / "s3/summary.jsonl").c_str(), 0600) == 0);
    const CliResult pipe = merge({"s3", "--meshes", "in", "-o", "out"});
    CHECK(pipe.status == 3);
    CHECK(holds(pipe.err, "skelgen: error: s3/summary.jsonl: is not there or cannot be read"));
    CHECK_FALSE(fs::exists(folder / "out"));
    write_file(folder / "file", "");
    CHECK(merge({"s1", "--meshes", "in", "-o", "file"}).status == 2);
}

} // namespace
