#include "manual_page.hpp"

#include <algorithm>
#include <cctype>

#include <skelgen/version.hpp>

namespace skelgen::cli {
namespace {

/// Text as troff takes it: hyphens are minus signs, as in what is typed; nothing is a request.
std::string roff(const std::string& text) {
    std::string out;
    for (const char c : text) {
        if (c == '\\')
            out += "\\e";
        else if (c == '-')
            out += "\\-";
        else
            out += c;
    }
    if (!out.empty() && (out.front() == '.' || out.front() == '\'')) out.insert(0, "\\&");
    return out;
}

std::string bold(const std::string& text) { return "\\fB" + roff(text) + "\\fR"; }
std::string italic(const std::string& text) { return "\\fI" + roff(text) + "\\fR"; }

std::string joined(const std::vector<std::string>& texts, const std::string& between,
                   std::string (*format)(const std::string&)) {
    std::string out;
    for (const std::string& text : texts) out += (out.empty() ? "" : between) + format(text);
    return out;
}

std::string upper(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return text;
}

std::string value_of(const OptionOutline& option) {
    if (!option.choices.empty()) return joined(option.choices, "|", bold);
    return italic(option.value);
}

std::string synopsis(const CommandOutline& program, const CommandOutline& command) {
    if (&program == &command) return bold(program.name) + " " + italic("COMMAND") + " [" + italic("OPTIONS") + "]";
    std::string out = bold(program.name + " " + command.name);
    for (const OptionOutline& positional : command.positionals)
        out += " " + italic(positional.name) + (positional.takes_many ? "..." : "");
    for (const OptionOutline& option : command.options)
        if (option.is_required) out += " " + bold(option.flags.front()) + " " + value_of(option);
    for (const std::vector<OptionOutline>& options : command.alternatives) {
        std::string any;
        for (const OptionOutline& option : options)
            any += (any.empty() ? "" : " | ") + bold(option.flags.front()) + " " + value_of(option);
        out += " {" + any + "}";
    }
    return out + " [" + italic("OPTIONS") + "]";
}

std::string entry(const OptionOutline& option) {
    std::string out = ".TP\n";
    if (option.flags.empty())
        out += italic(option.name) + (option.takes_many ? "..." : "");
    else
        out += joined(option.flags, ", ", bold) + (option.value.empty() ? "" : " " + value_of(option));
    out += "\n" + roff(option.help);
    if (!option.range.empty()) out += "; in " + roff(option.range);
    if (!option.default_value.empty()) out += "; by default " + bold(option.default_value);
    return out + ".\n";
}

/// A paragraph below the options: examples as they are typed, all else as text, under a heading of their own where the
/// paragraph begins with one.
std::string section(const std::vector<std::string>& lines) {
    if (lines.front().rfind("Example", 0) == 0) {
        std::string out = ".SH EXAMPLES\n.nf\n";
        for (std::size_t i = 1; i < lines.size(); ++i) out += roff(lines[i]) + "\n";
        return out + ".fi\n";
    }
    std::string text;
    for (const std::string& line : lines) text += (text.empty() ? "" : " ") + line;
    const std::string exit_status = "Exit status: ";
    if (text.rfind(exit_status, 0) == 0) return ".SH EXIT STATUS\n" + roff(text.substr(exit_status.size())) + "\n";
    return ".SH NOTES\n" + roff(text) + "\n";
}

std::string see_also(const CommandOutline& program, const CommandOutline& command) {
    std::string out = ".SH SEE ALSO\n";
    if (&program != &command) return out + bold(program.name) + "(1)\n";
    std::string pages;
    for (const CommandOutline& each : program.commands)
        pages += (pages.empty() ? "" : ",\n") + bold(manual_page_name(program, each)) + "(1)";
    return out + pages + "\n";
}

} // namespace

std::string manual_page_name(const CommandOutline& program, const CommandOutline& command) {
    return &program == &command ? program.name : program.name + "-" + command.name;
}

std::string manual_page(const CommandOutline& program, const CommandOutline& command) {
    const std::string name = manual_page_name(program, command);
    std::string out = ".TH " + roff(upper(name)) + " 1 \"\" \"" + roff(program.name + " " + std::string(version)) +
                      "\" \"" + roff(program.name) + "\"\n.SH NAME\n" + roff(name) + " \\- " +
                      roff(command.description) + "\n.SH SYNOPSIS\n" + synopsis(program, command) + "\n";
    if (!command.commands.empty()) {
        out += ".SH COMMANDS\n";
        for (const CommandOutline& each : command.commands)
            out += ".TP\n" + bold(each.name) + "\n" + roff(each.description) + ".\n";
    }
    if (!command.positionals.empty() || !command.options.empty()) out += ".SH OPTIONS\n";
    for (const auto* options : {&command.positionals, &command.options})
        for (const OptionOutline& option : *options) out += entry(option);
    for (const std::vector<std::string>& paragraph : command.notes) out += section(paragraph);
    return out + see_also(program, command);
}

} // namespace skelgen::cli
