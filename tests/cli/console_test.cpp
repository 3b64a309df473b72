#include <filesystem>
#include <regex>
#include <string>
#include <sys/stat.h>

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

} // namespace
