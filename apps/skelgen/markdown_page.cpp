#include "markdown_page.hpp"

namespace skelgen::cli {
namespace {

/// Text in a table's cell: what Markdown or HTML would take for its own is shown as it is.
std::string cell(const std::string& text) {
    std::string out;
    for (const char c : text) {
        if (c == '<')
            out += "&lt;";
        else if (c == '|' || c == '*' || c == '_' || c == '[' || c == ']')
            out += std::string("\\") + c;
        else
            out += c;
    }
    return out;
}

std::string code(const std::string& text) { return "`" + text + "`"; }

std::string codes(const std::vector<std::string>& texts) {
    std::string out;
    for (const std::string& text : texts) out += (out.empty() ? "" : ", ") + code(text);
    return out;
}

std::string name_of(const OptionOutline& option) {
    if (option.flags.empty()) return code(option.name + (option.takes_many ? "..." : ""));
    return codes(option.flags) + (option.value.empty() || !option.choices.empty() ? "" : " " + option.value);
}

std::string row(const OptionOutline& option) {
    std::string out = "| " + name_of(option) + " | " + cell(option.help) + ".";
    if (option.is_required && !option.flags.empty()) out += " Required.";
    if (!option.choices.empty()) out += " One of " + codes(option.choices) + ".";
    if (!option.range.empty()) out += " In " + cell(option.range) + ".";
    if (!option.default_value.empty()) out += " By default " + code(option.default_value) + ".";
    return out + " |\n";
}

std::string usage(const CommandOutline& program, const CommandOutline& command) {
    std::string out = program.name + " " + command.name;
    for (const OptionOutline& positional : command.positionals)
        out += " " + positional.name + (positional.takes_many ? "..." : "");
    for (const OptionOutline& option : command.options)
        if (option.is_required) out += " " + option.flags.front() + " " + option.value;
    return out + " [OPTIONS]";
}

} // namespace

std::string markdown_page(const CommandOutline& program, const CommandOutline& command) {
    std::string out = "```text\n" + usage(program, command) + "\n```\n\n| option | what it does |\n|---|---|\n";
    for (const auto* options : {&command.positionals, &command.options})
        for (const OptionOutline& option : *options) out += row(option);
    for (const std::vector<OptionOutline>& options : command.alternatives) {
        std::string any;
        for (const OptionOutline& option : options) any += (any.empty() ? "" : ", ") + code(option.flags.back());
        out += "\nExactly one of " + any + " must be given.\n";
    }
    for (const std::vector<std::string>& paragraph : command.notes) {
        const bool is_example = paragraph.front().rfind("Example", 0) == 0;
        out += is_example ? "\nExamples:\n\n```text\n" : "\n";
        for (std::size_t i = is_example ? 1 : 0; i < paragraph.size(); ++i)
            out += (is_example ? paragraph[i] : cell(paragraph[i])) + "\n";
        if (is_example) out += "```\n";
    }
    return out;
}

} // namespace skelgen::cli
