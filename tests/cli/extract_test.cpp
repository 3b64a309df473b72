#include <regex>

#include <nlohmann/json.hpp>
#include <sys/stat.h>
#include <unistd.h>

#include "catch.hpp"
#include "json_schema.hpp"
#include "run_cli.hpp"

namespace {

using namespace skelgen::test;
namespace fs = std::filesystem;

/// Whether standard error is one line of the documented shape that begins with this file's name.
bool is_error_line(const std::string& err, const std::string& file) {
    return err.rfind("skelgen: error: " + file + ": ", 0) == 0 && err.find('\n') == err.size() - 1;
}

TEST_CASE("what is no mesh ends with status 3, one line, and no output") {
    const TemporaryFolder folder;
    const std::string vertices = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
    std::string file = "mesh.off";
    SECTION("missing file") {}
    SECTION("a folder") { fs::create_directory(folder / file); }
    SECTION("empty file") { write_file(folder / file, ""); }
    SECTION("truncated text") {
        const std::string sphere = sphere_off();
        write_file(folder / file, sphere.substr(0, sphere.size() / 2));
    }
    SECTION("truncated binary") {
        file = "mesh.ply";
        write_file(folder / file, "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\n"
                                  "property float y\nproperty float z\nelement face 1\n"
                                  "property list uchar int vertex_indices\nend_header\n\1\2\3");
    }
    SECTION("wrong magic") { write_file(folder / file, "GIF89a\1\2\3\4"); }
    SECTION("coordinate that is no number") {
        write_file(folder / file, "OFF\n4 2 0\n0 0 nan\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2\n3 0 1 3\n");
    }
    SECTION("infinite coordinate") {
        write_file(folder / file, "OFF\n4 2 0\n0 0 1e999\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2\n3 0 1 3\n");
    }
    SECTION("index out of range") { write_file(folder / file, "OFF\n4 1 0\n" + vertices + "3 0 1 4\n"); }
    SECTION("negative index") { write_file(folder / file, "OFF\n4 1 0\n" + vertices + "3 0 1 -1\n"); }
    SECTION("no faces") { write_file(folder / file, "OFF\n4 0 0\n" + vertices); }
    SECTION("counts that lie") { write_file(folder / file, "OFF\n2000000000 2000000000 0\n" + vertices); }

    const CliResult result = run_cli(folder.path(), {"extract", file, "-o", "out.json"});
    CHECK(result.status == 3);
    CHECK(is_error_line(result.err, file));
    CHECK(result.out.empty());
    CHECK_FALSE(fs::exists(folder / "out.json"));
    CHECK(files_below(folder.path()).size() <= 1); // nothing but the mesh
}

TEST_CASE("a surface that is no body ends with status 3 or 4, one line, and no output") {
    const TemporaryFolder folder;
    int expected = 4;
    SECTION("sphere") { write_file(folder / "mesh.off", sphere_off()); }
    SECTION("torus") { write_file(folder / "mesh.off", torus_off()); }
    SECTION("cube") { write_file(folder / "mesh.off", cube_off()); }
    SECTION("single triangle") {
        write_file(folder / "mesh.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
        expected = 0;
    }
    const CliResult result = run_cli(folder.path(), {"extract", "mesh.off", "-o", "out.json"});
    if (expected == 4)
        CHECK(result.status == 4);
    else
        CHECK((result.status == 3 || result.status == 4)); // a sheet, or a mesh that is no surface: both are true
    CHECK(is_error_line(result.err, "mesh.off"));
    CHECK(files_below(folder.path()) == std::vector<std::string>{"mesh.off"});
}

TEST_CASE("wrong usage ends with status 2 and one line") {
    const TemporaryFolder folder;
    const auto arguments =
        GENERATE(as<std::vector<std::string>>(), std::vector<std::string>{}, //
                 std::vector<std::string>{"frobnicate"},                     //
                 std::vector<std::string>{"--frobnicate"},                   //
                 std::vector<std::string>{"extract"},                        //
                 std::vector<std::string>{"extract", "a.off", "b.off"},
                 std::vector<std::string>{"extract", "a.off", "--frobnicate"},
                 std::vector<std::string>{"extract", "a.off", "-o"},
                 std::vector<std::string>{"extract", "a.off", "--threads", "0"},
                 std::vector<std::string>{"extract", "a.off", "--threads", "two"},
                 std::vector<std::string>{"extract", "a.off", "-v", "-q"},
                 std::vector<std::string>{"extract", "a.off", "--template", "horse"},
                 std::vector<std::string>{"batch", "a.off"}, std::vector<std::string>{"batch", "-o", "out"},
                 std::vector<std::string>{"batch", "a.off", "-o", "out", "--jobs", "0"},
                 std::vector<std::string>{"batch", "a.off", "-o", "out", "--jobs", "-1"},
                 std::vector<std::string>{"batch", "a.off", "-o", "out", "--timeout", "-1"},
                 std::vector<std::string>{"batch", "a.off", "-o", "out", "--timeout", "nan"},
                 std::vector<std::string>{"extract", "a.glb", "--animation", "1", "--time", "nan"},
                 std::vector<std::string>{"batch", "a.off", "-o", "out", "--shard", "0/2"},
                 std::vector<std::string>{"batch", "a.off", "-o", "out", "--shard", "3/2"},
                 std::vector<std::string>{"batch", "a.off", "-o", "out", "--shard", "1/2x"},
                 std::vector<std::string>{"evaluate", "truth"}, //
                 std::vector<std::string>{"curve", "a.off"});
    CAPTURE(arguments);
    const CliResult result = run_cli(folder.path(), arguments);
    CHECK(result.status == 2);
    CHECK(std::regex_match(result.err, std::regex("skelgen: error: [^\n]+: [^\n]+\n")));
    CHECK(result.out.empty());
    CHECK(files_below(folder.path()).empty());
}

TEST_CASE("help comes with an example, on standard output, with status 0") {
    const TemporaryFolder folder;
    const std::string command = GENERATE("", "extract", "batch", "evaluate", "curve", "render");
    std::vector<std::string> arguments{"--help"};
    if (!command.empty()) arguments.insert(arguments.begin(), command);
    const CliResult result = run_cli(folder.path(), arguments);
    CAPTURE(command);
    CHECK(result.status == 0);
    CHECK(result.out.find("Example") != std::string::npos);
    CHECK(result.out.find("skelgen " + (command.empty() ? "extract" : command) + " ") != std::string::npos);
    CHECK(result.err.empty());
}

TEST_CASE("the version is told") {
    const TemporaryFolder folder;
    const std::string option = GENERATE("--version", "-V");
    const CliResult result = run_cli(folder.path(), {option});
    CHECK(result.status == 0);
    CHECK(std::regex_match(result.out, std::regex("skelgen \\d+\\.\\d+\\.\\d+\n")));
}

TEST_CASE("the mesh is never replaced by the result") {
    const TemporaryFolder folder;
    write_file(folder / "mesh.off", cube_off());
    const std::string option = GENERATE("-o", "--curve");
    const CliResult result = run_cli(folder.path(), {"extract", "mesh.off", option, "./mesh.off"});
    CHECK(result.status == 2);
    CHECK(is_error_line(result.err, "./mesh.off"));
    CHECK(read_file(folder / "mesh.off") == cube_off());
}

TEST_CASE("one file for two results is refused before anything is done") {
    const TemporaryFolder folder;
    const CliResult result =
        run_cli(folder.path(), {"extract", sample_body, "-q", "-o", "out.json", "--curve", "./out.json"});
    CHECK(result.status == 2);
    CHECK(is_error_line(result.err, "out.json"));
    CHECK(result.err.find("--curve") != std::string::npos);
    CHECK(files_below(folder.path()).empty());
    CHECK(run_cli(folder.path(), {"extract", sample_body, "-q", "-o", "out.json", "--curve", "c.json"}).status == 0);
}

TEST_CASE("a person stays one where an animal is looked for, too, and is none where that alone is") {
    const TemporaryFolder folder;
    const CliResult either = run_cli(folder.path(), {"extract", sample_body, "--template", "auto", "-q"});
    CHECK(either.status == 0);
    CHECK(nlohmann::json::parse(either.out)["template"] == "human21");
    const CliResult animal = run_cli(folder.path(), {"extract", sample_body, "--template", "quadruped"});
    CHECK(animal.status == 4);
    CHECK(animal.err.find("no four-legged animal: ") != std::string::npos);
    const CliResult hinted =
        run_cli(folder.path(), {"extract", sample_body, "--template", "auto", "--hint", "head=0,0,1.5"});
    CHECK(hinted.status == 2);
    CHECK(hinted.err.find("not auto") != std::string::npos);
}

TEST_CASE("several meshes for extract: the message names batch") {
    const TemporaryFolder folder;
    const CliResult several = run_cli(folder.path(), {"extract", "a.off", "b.off"});
    CHECK(several.status == 2);
    CHECK(several.err.find("`skelgen batch`") != std::string::npos);
    const CliResult option = run_cli(folder.path(), {"extract", "a.off", "--frobnicate"});
    CHECK(option.err.find("`skelgen batch`") == std::string::npos);
}

TEST_CASE("of a refusal, -v tells what was tried, before the one line of the error") {
    const TemporaryFolder folder;
    write_file(folder / "torus.off", torus_off());
    const CliResult result = run_cli(folder.path(), {"extract", "torus.off", "-v", "-o", "out.json"});
    CHECK(result.status == 4);
    CHECK(std::regex_search(result.err, std::regex("^torus.off: tried largest_piece, draft: too_few_ends .*\n"
                                                   "(torus.off: tried [^\n]+\n)*"
                                                   "skelgen: error: torus.off: [^\n]+\n$")));
    CHECK(files_below(folder.path()) == std::vector<std::string>{"torus.off"});
    CHECK(is_error_line(run_cli(folder.path(), {"extract", "torus.off"}).err, "torus.off"));
}

TEST_CASE("file names may hold anything, and messages stay one line") {
    const TemporaryFolder folder;
    const CliResult result = run_cli(folder.path(), {"extract", "a\nb \xff.off"});
    CHECK(result.status == 3);
    CHECK(is_error_line(result.err, "a b \xff.off"));
}

TEST_CASE("a body's skeleton fits the schema and is the same bytes every time, timings aside") {
    const TemporaryFolder folder;
    const CliResult to_file = run_cli(folder.path(), {"extract", sample_body, "-o", "out.json", "--curve", "c.obj"});
    REQUIRE(to_file.status == 0);
    CHECK(to_file.out.empty());
    const CliResult to_stdout = run_cli(folder.path(), {"extract", sample_body, "-q", "--threads", "2"});
    REQUIRE(to_stdout.status == 0);
    CHECK(to_stdout.err.empty());
    CHECK(files_below(folder.path()) == std::vector<std::string>{"c.obj", "out.json"});

    const std::regex timings("\"timings_ms\": \\{[^}]*\\}");
    const std::string text = read_file(folder / "out.json");
    CHECK(std::regex_replace(text, timings, "") == std::regex_replace(to_stdout.out, timings, ""));

    const nlohmann::json document = nlohmann::json::parse(text);
    CHECK(schema_faults(document, SKELGEN_DATA "/schema/skeleton.schema.json").empty());
    CHECK(document["joints"].size() == 21);
    CHECK(document["mesh"]["file"] == "body.off");
}

TEST_CASE("with fingers, the file has all joints of human51 and fits the schema") {
    const TemporaryFolder folder;
    const auto extract = [&](const std::vector<std::string>& options) {
        std::vector<std::string> arguments{"extract", sample_body, "-o", "out.json", "-q"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        REQUIRE(run_cli(folder.path(), arguments).status == 0);
        return read_file(folder / "out.json");
    };
    const auto without = nlohmann::json::parse(extract({}));
    const auto by_template = nlohmann::json::parse(extract({"--template", "human51"}));
    const auto on = nlohmann::json::parse(extract({"--fingers", "on"}));
    CHECK(schema_faults(on, SKELGEN_DATA "/schema/skeleton.schema.json").empty());
    CHECK(on["template"] == "human51");
    CHECK(on["joints"] == by_template["joints"]);
    REQUIRE(on["joints"].size() == 51);
    for (std::size_t j = 0; j < without["joints"].size(); ++j) CHECK(on["joints"][j] == without["joints"][j]);
    CHECK(on["joints"][21]["name"] == "left_thumb_1");
    CHECK(on["joints"][21]["parent"] == "left_wrist");
    CHECK(on["joints"][50]["name"] == "right_little_3");

    for (const auto& joint : on["joints"]) CHECK(joint.value("present", true)); // the sample has all digits
    CHECK(on["end_points"].contains("right_little_tip"));
    CHECK(nlohmann::json::parse(extract({"--fingers", "auto"}))["joints"] == on["joints"]);

    const CliResult refused =
        run_cli(folder.path(), {"extract", sample_body, "--template", "pinocchio18", "--fingers", "on"});
    CHECK(refused.status == 2);
    CHECK(refused.err.find("human21 alone") != std::string::npos);
}

TEST_CASE("with toes, the file has their joints; the sample's foot shows none, and so they are not present") {
    const TemporaryFolder folder;
    const auto extract = [&](const std::vector<std::string>& options) {
        std::vector<std::string> arguments{"extract", sample_body, "-o", "out.json", "-q", "--toes"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        return run_cli(folder.path(), arguments);
    };
    REQUIRE(extract({}).status == 0);
    const auto toed = nlohmann::json::parse(read_file(folder / "out.json"));
    CHECK(schema_faults(toed, SKELGEN_DATA "/schema/skeleton.schema.json").empty());
    CHECK(toed["template"] == "human21");
    REQUIRE(toed["joints"].size() == 41);
    CHECK(toed["joints"][21]["name"] == "left_toe1_1");
    CHECK(toed["joints"][21]["parent"] == "left_foot");
    CHECK(toed["joints"][40]["name"] == "right_toe5_2");
    for (std::size_t j = 21; j < 41; ++j) CHECK_FALSE(toed["joints"][j].value("present", true));
    CHECK(run_cli(folder.path(), {"rig", sample_body, "--skeleton", "out.json", "--toes", "-q", "-o", "out.glb"})
              .status == 0);
    REQUIRE(extract({"--fingers", "on"}).status == 0);
    CHECK(nlohmann::json::parse(read_file(folder / "out.json"))["joints"].size() == 71);
    const CliResult refused = extract({"--template", "quadruped"});
    CHECK(refused.status == 2);
    CHECK(refused.err.find("toes go with human21") != std::string::npos);
}

TEST_CASE("an output that is no place to write to ends with status 2 and one line") {
    const TemporaryFolder folder;
    fs::create_directory(folder / "folder");
    const std::string output = GENERATE("missing/out.json", "folder");
    const CliResult result = run_cli(folder.path(), {"extract", sample_body, "-q", "-o", output});
    CHECK(result.status == 2);
    CHECK(is_error_line(result.err, output));
    CHECK((result.err.find("its folder does not exist") != std::string::npos) == (output != "folder"));
    CHECK(files_below(folder.path()).empty());
}

TEST_CASE("a result that cannot be stored ends with status 6, one line, and no output") {
    const TemporaryFolder folder;
    std::string line, place;
    SECTION("a full device") {
        line = "-o /dev/full";
        place = "/dev/full";
    }
    SECTION("a full device for the curve") {
        line = "-o out.json --curve full.obj";
        place = "full.obj";
        fs::create_symlink("/dev/full", folder / "full.obj");
    }
    SECTION("standard output to a full device") {
        line = "> /dev/full";
        place = "standard output";
    }
    SECTION("closed standard output") {
        line = ">&-";
        place = "standard output";
    }
    fs::copy_file(sample_body, folder / "body.off");
    const CliResult result = run_shell(folder.path(), "exec \"$skelgen\" extract body.off -q " + line);
    CHECK(result.status == 6);
    CHECK(is_error_line(result.err, place));
    CHECK_FALSE(fs::exists(folder / "out.json"));
}

TEST_CASE("a reader that has gone and a limit on the size of files are failures like others") {
    const TemporaryFolder folder;
    fs::copy_file(sample_body, folder / "body.off");
    const CliResult gone =
        run_shell(folder.path(), "{ \"$skelgen\" extract body.off -q; echo $? > status; } | sleep 0; cat status");
    CHECK(gone.out == "6\n");
    CHECK(is_error_line(gone.err, "standard output"));

    const CliResult limited =
        run_shell(folder.path(), "ulimit -f 1; exec \"$skelgen\" extract body.off -q -o out.json");
    CHECK(limited.status == 6);
    CHECK(files_below(folder.path()) == std::vector<std::string>{"body.off", "status"});
}

TEST_CASE("help that cannot be shown is no success") {
    const TemporaryFolder folder;
    const CliResult result = run_shell(folder.path(), "exec \"$skelgen\" --help > /dev/full");
    CHECK(result.status == 6);
    CHECK(is_error_line(result.err, "standard output"));
}

} // namespace
