#include <nlohmann/json.hpp>

#include <skelgen/io/read_mesh.hpp>

#include "catch.hpp"
#include "run_cli.hpp"

namespace {

using namespace skelgen::test;
namespace fs = std::filesystem;

TEST_CASE("synth writes a dressed body and its truth") {
    const TemporaryFolder folder;
    const CliResult result = run_cli(folder.path(), {"synth", "-o", "body.ply", "--truth", "truth.json", "--pose", "t",
                                                     "--faces", "5000", "--wear", "hat", "boots"});
    REQUIRE(result.status == 0);
    CHECK(result.out.empty());
    CHECK(files_below(folder.path()) == std::vector<std::string>{"body.ply", "truth.json"});
    CHECK(skelgen::read_mesh<double>(folder / "body.ply").faces.rows() == Approx(5000).epsilon(0.02));
    const auto truth = nlohmann::json::parse(read_file(folder / "truth.json"));
    CHECK(truth["mesh"] == "body.ply");
    CHECK(truth["joints"].size() == 21);
}

TEST_CASE("synth explains itself with an example") {
    const TemporaryFolder folder;
    const CliResult result = run_cli(folder.path(), {"synth", "--help"});
    CHECK(result.status == 0);
    CHECK(result.out.find("skelgen synth ") != std::string::npos);
    CHECK(result.err.empty());
}

TEST_CASE("a set needs a folder to go to") {
    const TemporaryFolder folder;
    write_file(folder / "file", "");
    const CliResult result = run_cli(folder.path(), {"synth", "--set", "not-a-body", "-o", "file"});
    CHECK(result.status == 2);
    CHECK(result.err.rfind("skelgen: error: file: ", 0) == 0);
    CHECK(files_below(folder.path()) == std::vector<std::string>{"file"});
}

TEST_CASE("a set for which there is no room ends with status 6 and names the file, in one line") {
    const TemporaryFolder folder;
    const CliResult result =
        run_shell(folder.path(), "ulimit -f 1; exec \"$skelgen\" synth --set not-a-body --faces 5000 -o set");
    CHECK(result.status == 6);
    CHECK(result.err.rfind("skelgen: error: set/meshes/not-a-body/", 0) == 0);
    CHECK(result.err.find('\n') == result.err.size() - 1);
    for (const std::string& file : files_below(folder.path())) CHECK(file.find(".off") == std::string::npos);
}

TEST_CASE("what synth cannot make ends with status 2 and one line") {
    const TemporaryFolder folder;
    const auto arguments =
        GENERATE(as<std::vector<std::string>>(),                                                         //
                 std::vector<std::string>{"--pose", "yoga"}, std::vector<std::string>{"--wear", "toga"}, //
                 std::vector<std::string>{"--age", "-3"}, std::vector<std::string>{"--faces", "10"},
                 std::vector<std::string>{"--sex", "x"}, //
                 std::vector<std::string>{"--set", "giraffes"});
    std::vector<std::string> all{"synth", "-o", "body.off"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const CliResult result = run_cli(folder.path(), all);
    CAPTURE(arguments);
    CHECK(result.status == 2);
    CHECK(result.err.rfind("skelgen: error: ", 0) == 0);
    CHECK(result.err.find('\n') == result.err.size() - 1);
    CHECK(files_below(folder.path()).empty());
}

} // namespace
