#include "command_outline.hpp"

#include <algorithm>
#include <sstream>
#include <utility>

namespace skelgen::cli {
namespace {

std::string in_one_line(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
}

std::vector<std::string> split(const std::string& text, char separator) {
    std::vector<std::string> parts;
    std::istringstream stream(text);
    for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
    return parts;
}

/// What CLI11 writes behind an option is "TYPE", then of each check ":{a,b}" or ":INT in [1 - 10]".
void read_type(const std::string& text, OptionOutline& option) {
    option.value = text.substr(0, text.find(':'));
    const auto between = [&](char open, char close) -> std::string {
        const std::size_t begin = text.find(open), end = text.find(close);
        if (begin == std::string::npos || end == std::string::npos) return "";
        return text.substr(begin + 1, end - begin - 1);
    };
    option.choices = split(between('{', '}'), ',');
    if (const std::string range = between('[', ']'); !range.empty()) option.range = "[" + range + "]";
}

OptionOutline outline_of(const CLI::Option& option) {
    OptionOutline out;
    for (const std::string& name : option.get_snames()) out.flags.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) out.flags.push_back("--" + name);
    if (out.flags.empty()) out.name = option.get_name(true);
    out.help = in_one_line(option.get_description());
    out.is_required = option.get_required();
    out.takes_many = option.get_items_expected_max() > 1;
    if (option.get_items_expected_max() == 0) return out; // a flag
    read_type(option.get_type_name(), out);
    out.default_value = option.get_default_str();
    return out;
}

/// Options in groups, too: CLI11 has those as nameless commands, each with a --help that is the command's.
void append_options(const CLI::App& app, CommandOutline& out) {
    for (const CLI::Option* option : app.get_options())
        (option->get_positional() ? out.positionals : out.options).push_back(outline_of(*option));
    for (const CLI::App* group : app.get_subcommands([](const CLI::App* sub) { return sub->get_name().empty(); })) {
        std::vector<OptionOutline> options;
        for (const CLI::Option* option : group->get_options())
            if (option != group->get_help_ptr()) options.push_back(outline_of(*option));
        out.options.insert(out.options.end(), options.begin(), options.end());
        if (group->get_require_option_min() == 1 && group->get_require_option_max() == 1)
            out.alternatives.push_back(std::move(options));
    }
}

std::vector<std::vector<std::string>> paragraphs_of(const std::string& text) {
    std::vector<std::vector<std::string>> paragraphs(1);
    for (const std::string& line : split(text, '\n'))
        if (!line.empty())
            paragraphs.back().push_back(line);
        else if (!paragraphs.back().empty())
            paragraphs.emplace_back();
    if (paragraphs.back().empty()) paragraphs.pop_back();
    return paragraphs;
}

} // namespace

CommandOutline outline(const CLI::App& app) {
    CommandOutline out;
    out.name = app.get_name();
    out.description = in_one_line(app.get_description());
    append_options(app, out);
    out.notes = paragraphs_of(app.get_footer());
    const auto is_shown = [](const CLI::App* sub) { return !sub->get_name().empty() && !sub->get_group().empty(); };
    for (const CLI::App* command : app.get_subcommands(is_shown)) out.commands.push_back(outline(*command));
    return out;
}

} // namespace skelgen::cli
