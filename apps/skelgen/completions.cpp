#include "completions.hpp"

#include <algorithm>
#include <array>
#include <string_view>

namespace skelgen::cli {
namespace {

/// What a value may be completed to.
enum class ValueKind { none, choice, folder, file, number };

ValueKind kind_of(const OptionOutline& option) {
    constexpr std::array<std::string_view, 3> numbers{"INT", "UINT", "FLOAT"};
    if (!option.choices.empty()) return ValueKind::choice;
    if (option.value.empty()) return ValueKind::none;
    if (option.value == "DIR") return ValueKind::folder;
    const bool is_number = std::find(numbers.begin(), numbers.end(), option.value) != numbers.end();
    return is_number ? ValueKind::number : ValueKind::file;
}

std::string joined(const std::vector<std::string>& words, const std::string& between) {
    std::string out;
    for (const std::string& word : words) out += (out.empty() ? "" : between) + word;
    return out;
}

std::string replaced(const std::string& text, char from, const std::string& to) {
    std::string out;
    for (const char c : text)
        if (c == from)
            out += to;
        else
            out += c;
    return out;
}

/// A help's beginning: shells show it beside what it explains, in one line.
std::string short_help(const std::string& help) {
    constexpr std::size_t longest = 72;
    if (help.size() <= longest) return help;
    return help.substr(0, help.rfind(' ', longest)) + " ...";
}

/// The words that may stand for an option or a command, of a command or of the program.
std::vector<std::string> words_of(const CommandOutline& command) {
    std::vector<std::string> words;
    for (const OptionOutline& option : command.options)
        words.insert(words.end(), option.flags.begin(), option.flags.end());
    return words;
}

std::vector<std::string> names_of(const std::vector<CommandOutline>& commands) {
    std::vector<std::string> names;
    for (const CommandOutline& command : commands) names.push_back(command.name);
    return names;
}

// -------------------------------------------------------------------------------------------------------------- bash

/// The lines that complete the values of a command's options, by "command:option".
std::string bash_values(const CommandOutline& command) {
    std::string out;
    for (const OptionOutline& option : command.options) {
        std::string reply;
        switch (kind_of(option)) {
        case ValueKind::none:
            continue;
        case ValueKind::choice:
            reply = "mapfile -t COMPREPLY < <(compgen -W '" + joined(option.choices, " ") + "' -- \"$current\")";
            break;
        case ValueKind::folder:
            reply = "mapfile -t COMPREPLY < <(compgen -d -- \"$current\")";
            break;
        case ValueKind::file:
            reply = "mapfile -t COMPREPLY < <(compgen -f -- \"$current\")";
            break;
        case ValueKind::number:
            reply = "COMPREPLY=()";
            break;
        }
        std::vector<std::string> patterns;
        for (const std::string& flag : option.flags) patterns.push_back(command.name + ":" + flag);
        out += "    " + joined(patterns, " | ") + ") " + reply + "; return ;;\n";
    }
    return out;
}

// --------------------------------------------------------------------------------------------------------------- zsh

/// In single quotes, where brackets and colons that mean something to _arguments are taken as they are.
std::string zsh_text(const std::string& text) {
    std::string out = short_help(text);
    for (const char special : {'[', ']', ':'}) out = replaced(out, special, std::string("\\") + special);
    return replaced(out, '\'', "'\\''");
}

std::string zsh_value(const OptionOutline& option) {
    switch (kind_of(option)) {
    case ValueKind::none:
        return "";
    case ValueKind::choice:
        return ":" + option.value + ":(" + joined(option.choices, " ") + ")";
    case ValueKind::folder:
        return ":" + option.value + ":_files -/";
    case ValueKind::file:
        return ":" + zsh_text(option.value) + ":_files";
    case ValueKind::number:
        return ":" + option.value + ":";
    }
    return "";
}

/// An option as _arguments takes it: '(-o --output)'{-o,--output}'[help]:value:_files'.
std::string zsh_option(const OptionOutline& option) {
    const std::string flags = option.flags.size() == 1
                                  ? "'" + option.flags.front()
                                  : "'(" + joined(option.flags, " ") + ")'{" + joined(option.flags, ",") + "}'";
    return flags + "[" + zsh_text(option.help) + "]" + zsh_value(option) + "'";
}

std::string zsh_arguments(const CommandOutline& command) {
    std::string out = "_arguments";
    for (const OptionOutline& option : command.options) out += " \\\n            " + zsh_option(option);
    return out + " \\\n            '*:file:_files'";
}

// -------------------------------------------------------------------------------------------------------------- fish

std::string fish_text(const std::string& text) {
    return "'" + replaced(replaced(short_help(text), '\\', "\\\\"), '\'', "\\'") + "'";
}

std::string fish_option(const std::string& condition, const OptionOutline& option) {
    std::string out = "complete -c skelgen -n '" + condition + "'";
    for (const std::string& flag : option.flags)
        out += flag.rfind("--", 0) == 0 ? " -l " + flag.substr(2) : " -s " + flag.substr(1);
    switch (kind_of(option)) {
    case ValueKind::none:
        break;
    case ValueKind::choice:
        out += " -x -a '" + joined(option.choices, " ") + "'";
        break;
    case ValueKind::folder:
        out += " -x -a '(__fish_complete_directories)'";
        break;
    case ValueKind::file:
        out += " -r -F";
        break;
    case ValueKind::number:
        out += " -x";
        break;
    }
    return out + " -d " + fish_text(option.help) + "\n";
}

} // namespace

std::string bash_completion(const CommandOutline& program) {
    std::string values, words;
    for (const CommandOutline& command : program.commands) {
        values += bash_values(command);
        words += "    " + command.name + ") words='" + joined(words_of(command), " ") + "' ;;\n";
    }
    std::vector<std::string> first = names_of(program.commands);
    const std::vector<std::string> options = words_of(program);
    first.insert(first.end(), options.begin(), options.end());
    return "# Completion of skelgen for bash: made by skelgen from its own help.\n"
           "_skelgen() {\n"
           "    local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]} command= words= i\n"
           "    if [[ $current == = ]]; then # as in --names=\n"
           "        current=\n"
           "    elif [[ $previous == = ]]; then\n"
           "        previous=${COMP_WORDS[COMP_CWORD - 2]}\n"
           "    fi\n"
           "    for ((i = 1; i < COMP_CWORD; ++i)); do\n"
           "        if [[ ${COMP_WORDS[i]} != -* ]]; then\n"
           "            command=${COMP_WORDS[i]}\n"
           "            break\n"
           "        fi\n"
           "    done\n"
           "    case $command:$previous in\n" +
           values +
           "    esac\n"
           "    case $command in\n"
           "    '') words='" +
           joined(first, " ") + "' ;;\n" + words +
           "    esac\n"
           "    if [[ -z $command || $current == -* ]]; then\n"
           "        mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$current\")\n"
           "    else\n"
           "        mapfile -t COMPREPLY < <(compgen -f -- \"$current\")\n"
           "    fi\n"
           "}\n"
           "complete -o filenames -F _skelgen skelgen\n";
}

std::string zsh_completion(const CommandOutline& program) {
    std::string commands, cases;
    for (const CommandOutline& command : program.commands) {
        commands += "        '" + command.name + ":" + zsh_text(command.description) + "'\n";
        cases += "        " + command.name + ")\n            " + zsh_arguments(command) + "\n            ;;\n";
    }
    std::string options;
    for (const OptionOutline& option : program.options) options += " \\\n        " + zsh_option(option);
    return "#compdef skelgen\n"
           "# Completion of skelgen for zsh: made by skelgen from its own help.\n"
           "_skelgen() {\n"
           "    local context state state_descr line\n"
           "    typeset -A opt_args\n"
           "    local -a commands=(\n" +
           commands +
           "    )\n"
           "    _arguments -C" +
           options +
           " \\\n        '1:command:->command' '*::argument:->argument'\n"
           "    case $state in\n"
           "    command) _describe command commands ;;\n"
           "    argument)\n"
           "        case $words[1] in\n" +
           cases +
           "        esac\n"
           "        ;;\n"
           "    esac\n"
           "}\n"
           "if [[ $funcstack[1] == _skelgen ]]; then _skelgen \"$@\"; else compdef _skelgen skelgen; fi\n";
}

std::string fish_completion(const CommandOutline& program) {
    std::string out = "# Completion of skelgen for fish: made by skelgen from its own help.\n";
    for (const OptionOutline& option : program.options) out += fish_option("__fish_use_subcommand", option);
    for (const CommandOutline& command : program.commands)
        out += "complete -c skelgen -n __fish_use_subcommand -f -a " + command.name + " -d " +
               fish_text(command.description) + "\n";
    for (const CommandOutline& command : program.commands)
        for (const OptionOutline& option : command.options)
            out += fish_option("__fish_seen_subcommand_from " + command.name, option);
    return out;
}

} // namespace skelgen::cli
