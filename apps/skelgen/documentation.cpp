#include <filesystem>
#include <memory>
#include <string>

#include "command_outline.hpp"
#include "commands.hpp"
#include "completions.hpp"
#include "console.hpp"
#include "manual_page.hpp"
#include "markdown_page.hpp"

namespace skelgen::cli {
namespace {

namespace fs = std::filesystem;

void write(const fs::path& file, const std::string& text) {
    make_folder(file.parent_path());
    write_result(file.string(), text);
}

/// All pages and scripts, in folders as below /usr/share.
void write_documentation(const CommandOutline& program, const fs::path& folder) {
    const fs::path pages = folder / "man/man1";
    write(pages / (program.name + ".1"), manual_page(program, program));
    for (const CommandOutline& command : program.commands)
        write(pages / (manual_page_name(program, command) + ".1"), manual_page(program, command));
    // For the manual, which has them in its own pages; they are not installed.
    for (const CommandOutline& command : program.commands)
        write(folder / "commands" / (command.name + ".md"), markdown_page(program, command));
    write(folder / "bash-completion/completions" / program.name, bash_completion(program));
    write(folder / "zsh/site-functions" / ("_" + program.name), zsh_completion(program));
    write(folder / "fish/vendor_completions.d" / (program.name + ".fish"), fish_completion(program));
}

} // namespace

void add_documentation_command(CLI::App& app) {
    auto folder = std::make_shared<std::string>();
    CLI::App* sub = app.add_subcommand("documentation", "Write manual pages and completions for bash, zsh and fish");
    sub->group(""); // for those who package skelgen: its own build runs it
    sub->add_option("FOLDER", *folder, "Where to write them, in folders as below /usr/share")->required();
    sub->callback([&app, folder] { write_documentation(outline(app), *folder); });
}

} // namespace skelgen::cli
