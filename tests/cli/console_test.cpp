#include <filesystem>
#include <regex>
#include <string>
#include <sys/stat.h>
#include <vector>

#include <skelgen/io/read_mesh.hpp>

#include "catch.hpp"
#include "run_cli.hpp"

namespace {

using namespace skelgen::test;

/// Whether there is the command script, which is a terminal.
bool has_terminal(const std::filesystem::path& folder) { return run_shell(folder, "command -v script").status == 0; }

/// What a line of shell, in which $skelgen is the program, shows on a terminal. The line has no ' in it.
std::string on_terminal(const std::filesystem::path& folder, const std::string& line) {
    return run_shell(folder, "export skelgen; exec script -qec '" + line + "' /dev/null").out;
}

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST_CASE("on a terminal, what takes long says for how long it has", "[cli][console]") {
    const TemporaryFolder folder;
    if (!has_terminal(folder.path())) SKELGEN_SKIP("needs the command script, which is a terminal");
    write_file(folder / "body.off", read_file(sample_body));
    const std::string slow = "(sleep 2.5; cat body.off) | \"$skelgen\" extract - -o body.json";
    const std::string shown = on_terminal(folder.path(), slow);
    CHECK(holds(shown, "\r\033[K-: 2 s"));
    CHECK_FALSE(holds(shown, "-: 1 s"));
    CHECK(shown.substr(0, shown.find_last_not_of("\r\n") + 1).ends_with("\r\033[K")); // it is gone again
    CHECK(std::filesystem::exists(folder / "body.json"));
    CHECK_FALSE(holds(on_terminal(folder.path(), slow + " -q"), "-: "));
    CHECK_FALSE(holds(on_terminal(folder.path(), "\"$skelgen\" extract body.off -o body.json"), "body.off: "));
    CHECK_FALSE(holds(run_shell(folder.path(), slow).err, "-: ")); // no terminal
}

TEST_CASE("on a terminal, a command that takes long over several meshes shows how many are done", "[cli][console]") {
    const TemporaryFolder folder;
    if (!has_terminal(folder.path())) SKELGEN_SKIP("needs the command script, which is a terminal");
    for (const char* file : {"in/a.off", "in/b.off"}) write_file(folder / file, read_file(sample_body));
    const std::string quick = on_terminal(folder.path(), "\"$skelgen\" measure in -o out.json");
    CHECK_FALSE(holds(quick, "/2"));
    write_file(folder / "body.off", read_file(sample_body));
    REQUIRE(::mkfifo((folder / "slow.off").c_str(), 0600) == 0);
    const std::string shown =
        on_terminal(folder.path(),
                    "(sleep 2.5; cat body.off >slow.off) & \"$skelgen\" measure in/a.off slow.off -o out.json; wait");
    CHECK(holds(shown, "slow.off: 2 s"));
    CHECK(std::regex_search(shown, std::regex("\\[#+\\] 2/2")));
}

TEST_CASE("the program starts without the libraries that only scenes need", "[cli][console]") {
    const TemporaryFolder folder;
    const std::string loaded = run_shell(folder.path(), "LD_TRACE_LOADED_OBJECTS=1 \"$skelgen\" --version").out;
    CHECK(holds(loaded, "libc.so"));
    CHECK_FALSE(holds(loaded, "assimp"));
    CHECK_FALSE(holds(loaded, "meshoptimizer"));
}

TEST_CASE("commands and options with a letter wrong are answered by the one that is meant", "[cli][console]") {
    const TemporaryFolder folder;
    const auto says = [&](const std::vector<std::string>& arguments, const std::string& part) {
        const CliResult result = run_cli(folder.path(), arguments);
        INFO(result.err);
        CHECK(result.status == 2);
        CHECK(holds(result.err, part));
        CHECK(result.err.find('\n') == result.err.size() - 1);
    };
    says({"rgi", "body.off"}, "rgi: is no command of skelgen; did you mean rig? see `skelgen --help`");
    says({"extarct", "body.off"}, "did you mean extract?");
    says({"rig", sample_body, "-o", "x.glb", "--nmaes=vrm"}, "; did you mean --names?; see `skelgen rig --help`");
    says({"rig", sample_body, "-o", "x.glb", "--rest", "t-pos"}, "; did you mean t-pose?; see `skelgen rig --help`");
    says({"rig", sample_body, "-o", "x.glb", "--names", "mixmo"}, "; did you mean mixamo?");
    says({"extract", sample_body, "--hint", "left_hnd=0,0,0"}, "there is no such joint; did you mean left_hand?");
    says({"extract", sample_body, "--hint", "left_hand=900,0,0"},
         "hint left_hand: its place is far outside of the mesh");
    const CliResult far = run_cli(folder.path(), {"paint", "body.off"});
    CHECK_FALSE(holds(far.err, "did you mean"));
}

TEST_CASE("batch: a folder that is not there is no input, a mesh that is not there a failure of its own",
          "[cli][batch]") {
    const TemporaryFolder folder;
    const CliResult nothing = run_cli(folder.path(), {"batch", "scans", "-o", "out"});
    CHECK(nothing.status == 3);
    CHECK(nothing.err == "skelgen: error: scans: there is no such folder or file; check the name\n");
    CHECK(run_cli(folder.path(), {"batch", "missing.off", "-o", "out", "-q"}).status == 5);
}

TEST_CASE("extract: what is refused names the limb, with its place; -q still says that it is a guess",
          "[cli][console]") {
    const TemporaryFolder folder;
    // A body without what is below its arms, with the vertices of all.
    const auto mesh = skelgen::read_mesh(sample_body);
    std::string off = "OFF\n" + std::to_string(mesh.vertices.rows()) + " FACES 0\n";
    for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
        for (const double x : mesh.vertices.row(v)) off += std::to_string(x) + ' ';
        off += '\n';
    }
    int faces = 0;
    const double middle = mesh.vertices.col(2).minCoeff() + 1.15;
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
        bool is_above = true;
        std::string line = "3";
        for (const int v : mesh.faces.row(f)) {
            is_above = is_above && mesh.vertices(v, 2) > middle;
            line += ' ' + std::to_string(v);
        }
        if (!is_above) continue;
        off += line + '\n';
        ++faces;
    }
    off.replace(off.find("FACES"), 5, std::to_string(faces));
    write_file(folder / "bust.off", off);
    const CliResult bust = run_cli(folder.path(), {"extract", "bust.off"});
    INFO(bust.err);
    CHECK(bust.status == 4);
    CHECK((holds(bust.err, "is the least certain, at ") || holds(bust.err, "is not found beyond ")));

    const CliResult guess =
        run_cli(folder.path(), {"extract", sample_body, "--hint", "head=0,0,0", "-q", "-o", "guess.json"});
    INFO(guess.err);
    CHECK(guess.status == 0);
    CHECK(holds(guess.err, "the skeleton is a guess: confidence 0."));
    CHECK(guess.err.find('\n') == guess.err.size() - 1);
}

TEST_CASE("batch --resume --report does nothing again", "[cli][batch]") {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "scans");
    std::filesystem::copy_file(sample_body, folder / "scans/body.off");
    for (const char* counts : {"1 done now, 0 done before", "0 done now, 1 done before"}) {
        const CliResult done =
            run_cli(folder.path(), {"batch", "scans", "-o", "out", "--resume", "--report", "report.html"});
        INFO(done.err);
        CHECK(done.status == 0);
        CHECK(holds(done.err + done.out, counts));
        CHECK(std::filesystem::exists(folder / "report.html"));
    }
}

TEST_CASE("repairs of a surface are one line, and each its own under -v", "[cli][console]") {
    // Every face with corners of its own, and one twice.
    const auto mesh = skelgen::read_mesh(sample_body);
    std::string off =
        "OFF\n" + std::to_string(mesh.faces.size()) + ' ' + std::to_string(mesh.faces.rows() + 1) + " 0\n";
    for (Eigen::Index i = 0; i < mesh.faces.size(); ++i) {
        for (const double x : mesh.vertices.row(mesh.faces.data()[i])) off += std::to_string(x) + ' ';
        off += '\n';
    }
    for (Eigen::Index f = 0; f <= mesh.faces.rows(); ++f) {
        const std::string first = std::to_string(3 * (f % mesh.faces.rows()));
        off += "3 " + first + ' ' + std::to_string(3 * (f % mesh.faces.rows()) + 1) + ' ' +
               std::to_string(3 * (f % mesh.faces.rows()) + 2) + '\n';
    }
    const TemporaryFolder folder;
    write_file(folder / "soup.off", off);
    const auto lines = [](const std::string& text, const std::string& part) {
        int count = 0;
        for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
        return count;
    };
    const std::string usual = run_cli(folder.path(), {"extract", "soup.off", "-o", "soup.json"}).err;
    INFO(usual);
    CHECK(lines(usual, ": repaired: ") == 1);
    CHECK(holds(usual, "soup.off: repaired: seams, duplicate faces\n"));
    const std::string all = run_cli(folder.path(), {"extract", "soup.off", "-o", "soup.json", "-v"}).err;
    CHECK(lines(all, ": repaired: ") == 0);
    CHECK(lines(all, "warning: soup.off: seams welded") == 1);
    CHECK_FALSE(holds(run_cli(folder.path(), {"extract", "soup.off", "-o", "soup.json", "-q"}).err, "welded"));
}

} // namespace
