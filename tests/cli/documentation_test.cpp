#include <algorithm>
#include <filesystem>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "catch.hpp"
#include "run_cli.hpp"

namespace {

using namespace skelgen::test;
namespace fs = std::filesystem;

/// All words of a text that match.
std::set<std::string> found_in(const std::string& text, const std::string& pattern) {
    const std::regex expression(pattern);
    std::set<std::string> words;
    for (std::sregex_iterator at(text.begin(), text.end(), expression), end; at != end; ++at) words.insert((*at)[1]);
    return words;
}

std::string help_of(const fs::path& folder, const std::string& command) {
    std::vector<std::string> arguments{"--help"};
    if (!command.empty()) arguments.insert(arguments.begin(), command);
    return run_cli(folder, arguments).out;
}

std::set<std::string> commands(const fs::path& folder) {
    const std::string help = help_of(folder, "");
    const std::size_t first = help.find("Subcommands:");
    return found_in(help.substr(first, help.find("Example:") - first), "\n  ([a-z]+) ");
}

/// A folder with all pages and scripts.
struct Documentation {
    TemporaryFolder folder;
    Documentation() { REQUIRE(run_cli(folder.path(), {"documentation", "share"}).status == 0); }
};

bool has_program(const fs::path& folder, const std::string& name) {
    return run_shell(folder, "command -v " + name).status == 0;
}

/// What a line of shell prints; it must have nothing to complain of.
std::string printed_by(const fs::path& folder, const std::string& line) {
    const CliResult result = run_shell(folder, line);
    CHECK(result.err.empty());
    return result.out;
}

TEST_CASE("manual pages: one for each command, and one in Markdown, with every option of its help",
          "[cli][documentation]") {
    const Documentation documentation;
    const fs::path folder = documentation.folder.path(), pages = folder / "share/man/man1";
    const std::set<std::string> all = commands(folder);
    REQUIRE(all.size() >= 10);
    CHECK_FALSE(all.contains("documentation"));
    CHECK(files_below(pages).size() == all.size() + 1);
    const std::string overview = read_file(pages / "skelgen.1");
    for (const std::string& command : all) {
        INFO(command);
        CHECK(overview.find("\\fBskelgen\\-" + command + "\\fR(1)") != std::string::npos);
        const std::string page = read_file(pages / ("skelgen-" + command + ".1")), help = help_of(folder, command);
        CHECK(page.find("\n.SH EXAMPLES\n") != std::string::npos);
        const auto options = found_in(help, "\n  (?:-[a-zA-Z],)?--([a-z-]+)");
        CHECK(options.size() >= 2);
        const std::string manual = read_file(folder / "share/commands" / (command + ".md"));
        CHECK(manual.rfind("```text\nskelgen " + command, 0) == 0);
        for (std::string option : options) {
            CHECK(manual.find("`--" + option + "`") != std::string::npos);
            option = std::regex_replace("--" + option, std::regex("-"), "\\-");
            INFO(option);
            CHECK(page.find("\\fB" + option + "\\fR") != std::string::npos);
        }
    }
    const std::string rig = read_file(pages / "skelgen-rig.1");
    CHECK(rig.find("\\fBskelgen\\fR|\\fBsmpl\\fR|\\fBmixamo\\fR|\\fBvrm\\fR") != std::string::npos);
    const std::string pose = read_file(pages / "skelgen-pose.1"); // those in a group, too
    CHECK(pose.find("\\fB\\-\\-like\\fR") != std::string::npos);
    CHECK(overview.find(".SH EXIT STATUS\n0 done; 1 a fault") != std::string::npos);
}

TEST_CASE("manual pages: options of which one must be given are in the synopsis, and --help once",
          "[cli][documentation]") {
    const Documentation documentation;
    const std::string page = read_file(documentation.folder / "share/man/man1/skelgen-pose.1");
    CHECK(page.find("{\\fB\\-\\-like\\fR \\fITEXT\\fR | \\fB\\-\\-pose\\fR \\fITEXT\\fR | ") != std::string::npos);
    const std::string help = "\\fB\\-\\-help\\fR\n";
    REQUIRE(page.find(help) != std::string::npos);
    CHECK(page.find(help) == page.rfind(help));
}

TEST_CASE("manual pages: troff has nothing to complain of", "[cli][documentation]") {
    const Documentation documentation;
    const fs::path folder = documentation.folder.path();
    if (!has_program(folder, "groff")) SKELGEN_SKIP("groff is not there");
    const CliResult result = run_shell(folder, "groff -man -Tutf8 -ww -z share/man/man1/*.1");
    CHECK(result.status == 0);
    CHECK(result.err.empty());
}

TEST_CASE("completion: bash", "[cli][documentation]") {
    const Documentation documentation;
    const fs::path folder = documentation.folder.path();
    if (!has_program(folder, "bash")) SKELGEN_SKIP("bash is not there");
    write_file(folder / "complete.bash", "source share/bash-completion/completions/skelgen\n"
                                         "COMP_WORDS=(\"$@\") COMP_CWORD=$(($# - 1))\n"
                                         "_skelgen\nprintf '%s\\n' \"${COMPREPLY[@]}\" | sort\n");
    write_file(folder / "body.off", "");
    const auto completed = [&](const std::string& words) {
        std::vector<std::string> lines;
        std::istringstream text(printed_by(folder, "bash complete.bash " + words));
        for (std::string line; std::getline(text, line);) lines.push_back(line);
        return lines;
    };
    using Words = std::vector<std::string>;
    CHECK(completed("skelgen se") == Words{"segment"});
    CHECK(completed("skelgen --v") == Words{"--version"});
    CHECK(completed("skelgen ''").size() >= commands(folder).size());
    CHECK(completed("skelgen rig --na") == Words{"--names"});
    const Words joint_names{"godot",
                            "mesh2motion-fox",
                            "mesh2motion-horse",
                            "mixamo",
                            "rigify",
                            "skelgen",
                            "smpl",
                            "smplx",
                            "unity",
                            "unreal",
                            "vrm"};
    CHECK(completed("skelgen rig body.off --names ''") == joint_names);
    CHECK(completed("skelgen rig body.off --names = m") == Words{"mesh2motion-fox", "mesh2motion-horse", "mixamo"});
    CHECK(completed("skelgen rig --names =") == joint_names);
    CHECK(completed("skelgen rig bo") == Words{"body.off"});
    CHECK(completed("skelgen extract body.off -o bo") == Words{"body.off"});
    CHECK(completed("skelgen batch body.off -o ''") == Words{"share"}); // folders alone
    CHECK(completed("skelgen batch --jobs ''") == Words{""});
}

TEST_CASE("completion: fish", "[cli][documentation]") {
    const Documentation documentation;
    const fs::path folder = documentation.folder.path();
    if (!has_program(folder, "fish")) SKELGEN_SKIP("fish is not there");
    const auto completed = [&](const std::string& line) {
        return printed_by(folder, "HOME=$PWD fish -N -c 'source share/fish/vendor_completions.d/skelgen.fish; "
                                  "complete -C \"" +
                                      line + "\"' | cut -f 1");
    };
    CHECK(completed("skelgen seg") == "segment\n");
    CHECK(completed("skelgen rig --names v") == "vrm\n");
    CHECK(completed("skelgen rig --comp") == "--component\n");
}

TEST_CASE("completion: zsh", "[cli][documentation]") {
    const Documentation documentation;
    const fs::path folder = documentation.folder.path();
    if (!has_program(folder, "zsh")) SKELGEN_SKIP("zsh is not there");
    // What _arguments and _describe are given, instead of what they would show.
    write_file(folder / "complete.zsh", "_arguments() { [[ $1 == -C ]] && state=$want || print -rl -- \"$@\" }\n"
                                        "_describe() { print -rl -- \"${(P@)2}\" }\n"
                                        "compdef() { }\n"
                                        "want=$1; words=(\"${@[2,-1]}\")\n"
                                        "source share/zsh/site-functions/_skelgen\n_skelgen\n");
    const auto given = [&](const std::string& words) { return printed_by(folder, "zsh -f complete.zsh " + words); };
    const std::string first = given("command");
    for (const std::string& command : commands(folder)) CHECK(first.find(command + ":") != std::string::npos);
    const std::string rig = given("argument rig");
    CHECK(rig.find("--names[Whose names the joints get; VRM's own in .vrm]"
                   ":TEXT:(skelgen smpl mixamo vrm smplx unity godot unreal rigify "
                   "mesh2motion-fox mesh2motion-horse)\n") != std::string::npos);
    CHECK(rig.find("(-o --output)--output[") != std::string::npos);
    CHECK(rig.find("*:file:_files\n") != std::string::npos);
}

TEST_CASE("documentation that cannot be written is one line", "[cli][documentation]") {
    const TemporaryFolder folder;
    write_file(folder / "share", "");
    const CliResult result = run_cli(folder.path(), {"documentation", "share"});
    CHECK(result.status == 2);
    CHECK(result.err.rfind("skelgen: error: share/man/man1: cannot be made a folder", 0) == 0);
    CHECK(result.err.find('\n') == result.err.size() - 1);
}

} // namespace
