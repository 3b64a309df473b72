#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace skelgen::cli {

/// An option or a positional argument, as --help shows it.
struct OptionOutline {
    std::vector<std::string> flags;   ///< "-o", "--output"; empty for a positional
    std::string name;                 ///< of a positional: MESH
    std::string value;                ///< what stands for its value: TEXT, DIR, INT; empty where it takes none
    std::vector<std::string> choices; ///< the only values it may have; empty: any
    std::string range;                ///< of numbers: "[1 - 1000]"; empty: any
    std::string default_value;
    std::string help; ///< in one line
    bool is_required = false;
    bool takes_many = false;
};

/// A command and what is below it.
struct CommandOutline {
    std::string name;
    std::string description;
    std::vector<OptionOutline> options, positionals;
    std::vector<std::vector<OptionOutline>> alternatives; ///< options of each of which exactly one must be given
    /// What --help has below the options, by paragraphs with their lines: examples, exit status, notes.
    std::vector<std::vector<std::string>> notes;
    std::vector<CommandOutline> commands;
};

/// All that --help shows of a program and its commands; hidden ones are left out.
[[nodiscard]] CommandOutline outline(const CLI::App& app);

} // namespace skelgen::cli
