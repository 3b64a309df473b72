#include <algorithm>
#include <csignal>
#include <fcntl.h>
#include <map>
#include <regex>
#include <sys/stat.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include <skelgen/io/read_mesh.hpp>

#include "batch_results.hpp"
#include "catch.hpp"
#include "run_cli.hpp"

namespace {

using namespace skelgen::test;
using Json = nlohmann::json;
namespace fs = std::filesystem;

/// A named pipe that nobody writes to: reading it as a mesh takes forever.
class EndlessMesh {
public:
    explicit EndlessMesh(const fs::path& path) : path_(path) {
        fs::create_directories(path.parent_path());
        REQUIRE(::mkfifo(path.c_str(), 0600) == 0);
    }
    EndlessMesh(const EndlessMesh&) = delete;
    EndlessMesh& operator=(const EndlessMesh&) = delete;
    ~EndlessMesh() {
        if (writer_ >= 0) ::close(writer_);
    }

    /// Returns once somebody has begun to read.
    [[nodiscard]] bool wait_for_reader() {
        return wait_until([&] {
            writer_ = ::open(path_.c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC);
            return writer_ >= 0;
        });
    }

private:
    fs::path path_;
    int writer_ = -1;
};

const fs::path sample_body = SKELGEN_DATA "/sample/body.off";

TEST_CASE("every bad mesh has its line in the summary, and the batch ends with status 5") {
    const TemporaryFolder folder;
    write_file(folder / "in/empty.off", "");
    write_file(folder / "in/deep/er/sphere.off", sphere_off());
    write_file(folder / "in/text.OBJ", "hello");
    write_file(folder / "in/notes.txt", "no mesh");
    write_file(folder / "in/.hidden.off", "no mesh");
    const CliResult result = run_cli(folder.path(), {"batch", "in", "-o", "out"});
    CHECK(result.status == 5);
    CHECK(result.out.empty());
    CHECK(statuses(folder / "out") == std::map<std::string, std::string>{{"empty.off", "bad_input"},
                                                                         {"deep/er/sphere.off", "no_skeleton"},
                                                                         {"text.OBJ", "bad_input"}});
    const Json line = read_summary(folder / "out").at("empty.off");
    CHECK(line.at("error").get<std::string>().find("in/empty.off: ") == 0);
    CHECK(line.at("seconds").is_number());
    CHECK(line.at("faces") == 0);
    CHECK(line.at("warnings") == Json::array());
    CHECK(result.err.find("skelgen: error: in/empty.off: ") != std::string::npos);
    CHECK(files_below(folder / "out") == std::vector<std::string>{"summary.jsonl"});
}

TEST_CASE("inputs are folders, patterns and files") {
    const TemporaryFolder folder;
    for (const char* file : {"in/a/1.off", "in/a/2.off", "in/b/1.off", "in/b/c/3.ply", "x.off"})
        write_file(folder / file, "");
    std::vector<std::string> arguments;
    std::vector<std::string> expected;
    SECTION("folder") {
        arguments = {"in"};
        expected = {"a/1.off", "a/2.off", "b/1.off", "b/c/3.ply"};
    }
    SECTION("file") {
        arguments = {"in/b/c/3.ply"};
        expected = {"3.ply"};
    }
    SECTION("pattern for files") {
        arguments = {"in/?/1.off"};
        expected = {"a/1.off", "b/1.off"};
    }
    SECTION("pattern for folders") {
        arguments = {"in/[b-z]"};
        expected = {"b/1.off", "b/c/3.ply"};
    }
    SECTION("pattern for any depth") {
        arguments = {"in/**/*.ply"};
        expected = {"b/c/3.ply"};
    }
    SECTION("the same mesh named twice") {
        arguments = {"in", "in/*", "x.off"};
        expected = {"a/1.off", "a/2.off", "b/1.off", "b/c/3.ply", "x.off"};
    }
    arguments.insert(arguments.begin(), "batch");
    arguments.insert(arguments.end(), {"-o", "out"});
    CHECK(run_cli(folder.path(), arguments).status == 5); // they are all empty
    std::vector<std::string> files;
    for (const auto& [file, line] : read_summary(folder / "out")) files.push_back(file);
    CHECK(files == expected);
}

TEST_CASE("inputs that name no mesh end the batch before it starts") {
    const TemporaryFolder folder;
    fs::create_directory(folder / "empty");
    const std::string input = GENERATE("empty", "*.off");
    const CliResult result = run_cli(folder.path(), {"batch", input, "-o", "out"});
    CHECK(result.status == 3);
    CHECK(result.err.find("skelgen: error: " + input + ": ") == 0);
    CHECK_FALSE(fs::exists(folder / "out"));
}

TEST_CASE("two meshes of one name are wrong usage, and both are named") {
    const TemporaryFolder folder;
    write_file(folder / "a/mesh.off", "");
    write_file(folder / "b/mesh.off", "");
    const CliResult result = run_cli(folder.path(), {"batch", "a", "b", "-o", "out"});
    CHECK(result.status == 2);
    CHECK(result.err.find("a/mesh.off") != std::string::npos);
    CHECK(result.err.find("b/mesh.off") != std::string::npos);
    CHECK_FALSE(fs::exists(folder / "out"));
}

TEST_CASE("meshes that differ in their extension alone have outputs apart, and cost no other mesh anything") {
    const TemporaryFolder folder;
    fs::create_directory(folder / "in");
    fs::copy_file(sample_body, folder / "in/x.off");
    fs::copy_file(sample_body, folder / "in/y.off");
    write_file(folder / "in/x.ply", "no mesh");
    CHECK(run_cli(folder.path(), {"batch", "in", "-o", "out"}).status == 5);
    CHECK(statuses(folder / "out") ==
          std::map<std::string, std::string>{{"x.off", "ok"}, {"x.ply", "bad_input"}, {"y.off", "ok"}});
    CHECK(files_below(folder / "out") == std::vector<std::string>{"summary.jsonl", "x.off.json", "y.json"});
}

TEST_CASE("a folder that cannot be read costs its own meshes alone") {
    const TemporaryFolder folder;
    fs::permissions(folder.path(), fs::perms::all);
    if (run_shell(folder.path(), "exec setpriv --reuid=65534 --clear-groups \"$skelgen\" -V").status != 0)
        SKELGEN_SKIP("needs a user without rights, as the superuser can make one");
    write_file(folder / "in/a.off", "");
    write_file(folder / "in/closed/b.off", "");
    fs::permissions(folder / "in/closed", fs::perms::none);
    const CliResult result =
        run_shell(folder.path(), "exec setpriv --reuid=65534 --clear-groups \"$skelgen\" batch in -o out --jobs 1");
    fs::permissions(folder / "in/closed", fs::perms::owner_all);
    CHECK(result.status == 5);
    CHECK(result.err.find("skelgen: error: in/closed: cannot be searched: ") != std::string::npos);
    CHECK(statuses(folder / "out") ==
          std::map<std::string, std::string>{{"a.off", "bad_input"}, {"closed", "bad_input"}});
}

TEST_CASE("names that are no UTF-8 have a summary line each, in UTF-8") {
    const TemporaryFolder folder;
    for (const char* name : {"in/a\xff.off", "in/a\xfe.off", "in/a\\xff.off", "in/\xc3\xa4.off"})
        write_file(folder / name, "");
    CHECK(run_cli(folder.path(), {"batch", "in", "-o", "out"}).status == 5);
    std::vector<std::string> files;
    for (const auto& [file, line] : read_summary(folder / "out")) files.push_back(file);
    CHECK(files == std::vector<std::string>{"a\\\\xff.off", "a\\xfe.off", "a\\xff.off", "\xc3\xa4.off"});
}

TEST_CASE("shards share the meshes out, each to exactly one") {
    const TemporaryFolder folder;
    for (int i = 0; i < 7; ++i) write_file(folder / ("in/" + std::to_string(i) + ".off"), "");
    std::size_t lines = 0;
    for (const char* shard : {"1/3", "2/3", "3/3"}) {
        CHECK(run_cli(folder.path(), {"batch", "in", "-o", "apart/" + std::string(shard), "--shard", shard}).status ==
              5);
        lines += read_summary(folder / "apart" / shard).size();
        CHECK(run_cli(folder.path(), {"batch", "in", "-o", "together", "--shard", shard}).status == 5);
    }
    CHECK(lines == 7);
    CHECK(read_summary(folder / "together").size() == 7);
}

TEST_CASE("on a terminal, a bar shows how much is done, how fast, and how long the rest will take") {
    const TemporaryFolder folder;
    for (const char* file : {"in/a.off", "in/b.off", "in/c.off"}) write_file(folder / file, "");
    const CliResult result =
        run_shell(folder.path(), "export skelgen; exec script -qec '\"$skelgen\" batch in -o out --jobs 1' /dev/null");
    if (result.status == 126 || result.status == 127) SKELGEN_SKIP("needs the command script, which is a terminal");
    CHECK(std::regex_search(result.out, std::regex("\\[#+-+\\] 2/3, 2 failed, [0-9.]+/s, 0:0[0-9] left")));
    write_file(folder / "in/a.off", "");
    CHECK(run_cli(folder.path(), {"batch", "in", "-o", "out"}).err.find("/s, ") == std::string::npos); // no terminal
}

TEST_CASE("a mesh that takes too long is given up, alone") {
    const TemporaryFolder folder;
    const EndlessMesh endless(folder / "endless.off");
    write_file(folder / "in/bad.off", "");
    const CliResult result =
        run_cli(folder.path(), {"batch", "endless.off", "in", "-o", "out", "--timeout", "0.3", "--jobs", "1"});
    CHECK(result.status == 5);
    CHECK(statuses(folder / "out") ==
          std::map<std::string, std::string>{{"endless.off", "timeout"}, {"bad.off", "bad_input"}});
    CHECK(result.err.find("skelgen: error: endless.off: took longer than 0.3 s") != std::string::npos);
}

TEST_CASE("a worker that crashes costs the mesh it was at") {
    const TemporaryFolder folder;
    EndlessMesh endless(folder / "a.off");
    write_file(folder / "b.off", "");
    CliProcess batch(folder.path(), {"batch", "a.off", "b.off", "-o", "out", "--jobs", "1"});
    REQUIRE(endless.wait_for_reader());
    REQUIRE(batch.children().size() == 1);
    ::kill(batch.children()[0], SIGKILL); // a sanitizer would make something else of SIGSEGV
    const CliResult result = batch.wait();
    CHECK(result.status == 5);
    CHECK(statuses(folder / "out") == std::map<std::string, std::string>{{"a.off", "crash"}, {"b.off", "bad_input"}});
    CHECK(read_summary(folder / "out").at("a.off").at("error").get<std::string>().find("signal 9") !=
          std::string::npos);
}

TEST_CASE("an interrupt ends the workers and keeps what is done") {
    const TemporaryFolder folder;
    EndlessMesh endless(folder / "z.off");
    write_file(folder / "a.off", "");
    CliProcess batch(folder.path(), {"batch", "a.off", "z.off", "-o", "out", "--jobs", "1"});
    REQUIRE(endless.wait_for_reader());
    const auto workers = batch.children();
    REQUIRE(workers.size() == 1);
    batch.send(SIGINT);
    CHECK(batch.wait().status == 130);
    CHECK_FALSE(is_running(workers[0]));
    CHECK(statuses(folder / "out") == std::map<std::string, std::string>{{"a.off", "bad_input"}});
}

TEST_CASE("workers die with a batch that is killed") {
    const TemporaryFolder folder;
    EndlessMesh endless(folder / "a.off");
    CliProcess batch(folder.path(), {"batch", "a.off", "-o", "out"});
    REQUIRE(endless.wait_for_reader());
    const auto workers = batch.children();
    REQUIRE(workers.size() == 1);
    batch.send(SIGKILL);
    CHECK(batch.wait().status == -SIGKILL);
    CHECK(wait_until([&] { return !is_running(workers[0]); }));
}

TEST_CASE("resuming tries again what has failed, and repairs a summary cut off in the middle") {
    const TemporaryFolder folder;
    write_file(folder / "in/a.off", "");
    write_file(folder / "in/b.off", "");
    REQUIRE(run_cli(folder.path(), {"batch", "in", "-o", "out"}).status == 5);
    const auto before = results(folder / "out");

    const fs::path summary = folder / "out/summary.jsonl";
    fs::resize_file(summary, fs::file_size(summary) - 20);
    write_file(folder / "out/.skelgen-999999999-0.tmp", "half a file of a process that is no more");
    CHECK(run_cli(folder.path(), {"batch", "in", "-o", "out", "--resume"}).status == 5);
    CHECK(results(folder / "out") == before);

    write_file(folder / "in/a.off", sphere_off());
    CHECK(run_cli(folder.path(), {"batch", "in", "-o", "out", "--resume"}).status == 5);
    CHECK(statuses(folder / "out") ==
          std::map<std::string, std::string>{{"a.off", "no_skeleton"}, {"b.off", "bad_input"}});
}

TEST_CASE("resuming leaves alone what is done, and does again what has changed since") {
    const TemporaryFolder folder;
    fs::create_directory(folder / "in");
    fs::copy_file(sample_body, folder / "in/body.off");
    const std::vector<std::string> batch{"batch", "in", "-o", "out"};
    const auto resume = [&](const std::vector<std::string>& more = {}) {
        std::vector<std::string> arguments = batch;
        arguments.push_back("--resume");
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run_cli(folder.path(), arguments);
    };
    REQUIRE(run_cli(folder.path(), batch).status == 0);
    const fs::path result = folder / "out/body.json";
    const std::string first = read_file(result);
    const auto first_results = results(folder / "out");

    CHECK(resume().err.find("0 done now, 1 done before") != std::string::npos);
    CHECK(read_file(result) == first); // the timings, too: it is the same file

    SECTION("the result is garbled") {
        std::string garbled = first;
        garbled.replace(garbled.find("\"position\": [") + 13, 1, " ");
        write_file(result, garbled);
        CHECK(resume().status == 0);
        CHECK(results(folder / "out") == first_results);
    }
    SECTION("a number in the result is another one") {
        std::string garbled = first;
        const auto digit = garbled.find("\"radius\": 0.") + 13;
        garbled[digit] = garbled[digit] == '1' ? '2' : '1';
        write_file(result, garbled);
        CHECK(resume().status == 0);
        CHECK(results(folder / "out") == first_results);
    }
    SECTION("the mesh is another one") {
        write_file(folder / "in/body.off", sphere_off());
        CHECK(resume().status == 5);
        CHECK(statuses(folder / "out") == std::map<std::string, std::string>{{"body.off", "no_skeleton"}});
        CHECK_FALSE(fs::exists(result));
    }
    SECTION("the template is another one") {
        CHECK(resume({"--template", "pinocchio18"}).err.find("1 done now, 0 done before") != std::string::npos);
        CHECK(Json::parse(read_file(result)).at("template") == "pinocchio18");
    }
}

TEST_CASE("a mesh that needs more memory than it may take is given up, alone, and told why") {
#if defined(__SANITIZE_ADDRESS__)
    SKELGEN_SKIP("the address sanitizer takes more address space than any limit leaves");
#endif
    const TemporaryFolder folder;
    fs::create_directory(folder / "in");
    fs::copy_file(sample_body, folder / "in/body.off");
    std::string large = "OFF\n3000000 1 0\n";
    for (int i = 0; i < 3000000; ++i) large += "0 0 0\n";
    write_file(folder / "in/large.off", large + "3 0 1 2\n");
    const CliResult result = run_cli(folder.path(), {"batch", "in", "-o", "out", "--memory", "100", "--jobs", "1"});
    CHECK(result.status == 5);
    CHECK(statuses(folder / "out") == std::map<std::string, std::string>{{"body.off", "ok"}, {"large.off", "memory"}});
    CHECK(result.err.find("in/large.off: needs more memory than --memory 100 MiB") != std::string::npos);
}

TEST_CASE("a failing mesh leaves no result of an earlier run behind") {
    const TemporaryFolder folder;
    write_file(folder / "a.off", "");
    write_file(folder / "out/a.json", "{}");
    CHECK(run_cli(folder.path(), {"batch", "a.off", "-o", "out"}).status == 5);
    CHECK(files_below(folder / "out") == std::vector<std::string>{"summary.jsonl"});
}

TEST_CASE("a batch gives the bytes that extract gives, beside a bad file") {
    const TemporaryFolder folder;
    fs::create_directories(folder / "in/set");
    fs::copy_file(sample_body, folder / "in/set/body.off");
    write_file(folder / "in/bad.off", "");
    CHECK(run_cli(folder.path(), {"batch", "in", "-o", "out"}).status == 5);
    CHECK(files_below(folder / "out") == std::vector<std::string>{"set/body.json", "summary.jsonl"});
    CHECK(statuses(folder / "out") ==
          std::map<std::string, std::string>{{"bad.off", "bad_input"}, {"set/body.off", "ok"}});
    CHECK(read_summary(folder / "out").at("set/body.off").at("faces") == skelgen::read_mesh(sample_body).faces.rows());

    fs::create_directory(folder / "single");
    REQUIRE(run_cli(folder.path(), {"extract", "in/set/body.off", "-o", "single/body.json"}).status == 0);
    CHECK(results(folder / "out").at("set/body.json") == results(folder / "single").at("body.json"));
}

TEST_CASE("a batch that is killed and resumed gives what an undisturbed one gives") {
    const TemporaryFolder folder;
    fs::create_directory(folder / "in");
    for (int i = 0; i < 6; ++i) fs::copy_file(sample_body, folder / ("in/" + std::to_string(i) + ".off"));
    write_file(folder / "in/bad.off", "");
    const int undisturbed = run_cli(folder.path(), {"batch", "in", "-o", "whole", "--jobs", "2"}).status;

    CliProcess batch(folder.path(), {"batch", "in", "-o", "cut", "--jobs", "2"});
    REQUIRE(wait_until([&] {
        const std::string summary = read_file(folder / "cut/summary.jsonl");
        return std::count(summary.begin(), summary.end(), '\n') >= 2;
    }));
    batch.send(SIGKILL);
    CHECK(batch.wait().status == -SIGKILL);
    // The kill may also have come between a result and its line.
    for (const auto& entry : fs::directory_iterator(folder / "cut"))
        if (entry.path().extension() == ".json") {
            fs::remove(folder / "cut/summary.jsonl");
            break;
        }

    CHECK(run_cli(folder.path(), {"batch", "in", "-o", "cut", "--jobs", "2", "--resume"}).status == undisturbed);
    CHECK(results(folder / "cut") == results(folder / "whole"));
    CHECK(read_summary(folder / "cut").size() == 7);
}

} // namespace
