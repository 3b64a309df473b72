#include "program.hpp"

#include <algorithm>
#include <array>
#include <csignal>
#include <cstddef>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <limits>
#include <memory>
#include <new>
#include <string>
#include <string_view>
#include <vector>

#ifdef __GLIBC__
#include <malloc.h>
#include <sys/mman.h>
#endif

#include <skelgen/version.hpp>

#include "commands.hpp"
#include "console.hpp"
#include "nearest_word.hpp"

namespace skelgen::cli {
namespace {

constexpr int exit_status(ErrorCode code) { return static_cast<int>(code); }

/// A command that needs what not every build has: the build defines SKELGEN_WITH_... as 0 or 1.
struct OptionalCommand {
    std::string_view name;
    std::string_view build_option;
    bool is_there;
};

constexpr std::array<OptionalCommand, 4> optional_commands{
    {{"evaluate", "SKELGEN_BUILD_EVALUATION", SKELGEN_WITH_EVALUATION != 0},
     {"render", "SKELGEN_BUILD_RENDER", SKELGEN_WITH_RENDER != 0},
     {"synth", "SKELGEN_BUILD_SYNTH", SKELGEN_WITH_SYNTH != 0},
     {"view", "SKELGEN_BUILD_VIEW", SKELGEN_WITH_VIEW != 0}}};

struct Command {
    std::string_view name;
    void (*add)(CLI::App&);
};

constexpr std::array all_commands {
    Command{"extract", add_extract_command}, Command{"batch", add_batch_command}, Command{"merge", add_merge_command},
#if SKELGEN_WITH_EVALUATION
        Command{"evaluate", add_evaluate_command},
#endif
        Command{"curve", add_curve_command}, Command{"convert", add_convert_command},
        Command{"align", add_align_command}, Command{"segment", add_segment_command},
        Command{"measure", add_measure_command}, Command{"correspond", add_correspond_command},
        Command{"rig", add_rig_command}, Command{"pose", add_pose_command}, Command{"animate", add_animate_command},
#if SKELGEN_WITH_RENDER
        Command{"render", add_render_command},
#endif
#if SKELGEN_WITH_SYNTH
        Command{"synth", add_synth_command},
#endif
#if SKELGEN_WITH_VIEW
        Command{"view", add_view_command},
#endif
};

/// The command that the first argument names, alone: to describe all takes as long as to read a small mesh. All of them
/// where it names none, as in help.
void add_commands(CLI::App& app, std::string_view first_argument) {
    const auto named = std::find_if(all_commands.begin(), all_commands.end(),
                                    [&](const Command& command) { return command.name == first_argument; });
    if (named != all_commands.end()) return named->add(app);
    for (const Command& command : all_commands) command.add(app);
    add_documentation_command(app);
}

std::string footer() {
    std::string text =
        "Example:\n  skelgen extract body.off -o body.json\n\n"
        "Exit status: 0 done; 1 a fault of skelgen's own; 2 wrong usage; 3 the input cannot be read or is no\n"
        "mesh; 4 no skeleton is found. 5: some meshes failed (batch, merge, render, view). 6: the\n"
        "result cannot be stored, on a full disk for example.";
    for (const auto& [name, build_option, is_there] : optional_commands)
        if (!is_there)
            text += "\n\nNot in this build: " + std::string(name) + " (" + std::string(build_option) + " is off).";
    return text;
}

/// What is wrong with a first argument that is no command.
std::string unknown_command(std::string_view argument) {
    for (const auto& [name, build_option, is_there] : optional_commands)
        if (name == argument && !is_there)
            return "is not in this build of skelgen; build it with " + std::string(build_option) + "=ON";
    std::vector<std::string> names;
    for (const Command& command : all_commands) names.emplace_back(command.name);
    const std::string meant = nearest_word(argument, names);
    return "is no command of skelgen; " + (meant.empty() ? "" : "did you mean " + meant + "? ") +
           "see `skelgen --help`";
}

/// What someone may have meant who has given a command an option that it has not.
std::string meant_option(const CLI::App& command) {
    std::vector<std::string> names;
    for (const CLI::Option* option : command.get_options())
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    for (const std::string& argument : command.remaining()) {
        if (!argument.starts_with("--")) continue;
        const std::string meant = nearest_word(argument.substr(0, argument.find('=')), names);
        if (!meant.empty()) return "; did you mean " + meant + "?";
    }
    return "";
}

/// What someone may have meant who has given a word that is none of a list: "t-pos not in {as-is,t-pose}".
std::string meant_value(std::string_view message) {
    constexpr std::string_view between = " not in {";
    const std::size_t list = message.find(between), end = message.find('}', list);
    if (list == std::string_view::npos || end == std::string_view::npos) return "";
    std::vector<std::string> words{""};
    for (const char c : message.substr(list + between.size(), end - list - between.size()))
        if (c == ',')
            words.emplace_back();
        else
            words.back() += c;
    const std::size_t typed = message.rfind(' ', list - 1) + 1;
    const std::string meant = nearest_word(message.substr(typed, list - typed), words);
    return meant.empty() ? "" : "; did you mean " + meant + "?";
}

/// What to say to one who has given `extract` several meshes.
std::string hint(const CLI::App& command) {
    const std::vector<std::string> rest = command.remaining();
    const bool several = command.get_name() == "extract" && !rest.empty() && rest.front().front() != '-';
    return several ? "; for several meshes use `skelgen batch`" : "";
}

/// CLI11's own message in the shape of all others.
void print_usage_error(const CLI::App& app, const CLI::ParseError& error, const std::string& first_argument) {
    const auto commands = app.get_subcommands();
    if (!commands.empty()) {
        const std::string name = commands.front()->get_name();
        print_error(name + ": " + error.what() + hint(*commands.front()) + meant_option(*commands.front()) +
                    meant_value(error.what()) + "; see `skelgen " + name + " --help`");
    } else if (!first_argument.empty() && first_argument.front() != '-') {
        print_error(first_argument + ": " + unknown_command(first_argument));
    } else {
        print_error(std::string("command line: ") + error.what() + "; see `skelgen --help`");
    }
}

/// Writing to a pipe that nobody reads, or beyond the largest size that a file may have, would end the process without
/// a word and leave half a file behind: as failed writes they are reported like all others.
void make_signals_errors() {
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
}

/// What is freed is kept for the next large list: handed back and asked for again, its pages would have to be cleared
/// each time, which takes a fifth of the time on large meshes. Memory at the peak stays the same but for a few per
/// cent.
void keep_freed_memory() {
#ifdef __GLIBC__
    mallopt(M_MMAP_MAX, 0);
    mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
#endif
}

using Memory = std::unique_ptr<void, decltype(&std::free)>;

/// Room for what a body of some ten thousand faces takes, in large pages where the system has them: to be given small
/// ones, each of them when it is first written to, takes a fifth of such a body's time. Nothing is taken before it is
/// written to; what is freed here stays, as above. \return what lies before the first large page: as long as it is
/// kept, unused, no list gets small pages.
Memory ask_for_large_pages() {
    Memory room(nullptr, &std::free);
#if defined(__GLIBC__) && defined(MADV_HUGEPAGE)
    constexpr std::size_t page = std::size_t(2) << 20, bytes = 8 * page;
    room.reset(std::malloc(bytes + page));
    void* first = room.get();
    std::size_t left = bytes + page;
    if (!room || std::align(page, bytes, first, left) == nullptr) return room;
    madvise(first, bytes, MADV_HUGEPAGE);
    room.reset(std::realloc(room.release(), bytes + page - left));
#endif
    return room;
}

int run(int argc, char** argv) {
    make_signals_errors();
    keep_freed_memory();
    const Memory before_large_pages = ask_for_large_pages();
    CLI::App app("The kinematic skeleton of a human body, found in its triangle mesh by geometry alone.", "skelgen");
    app.set_version_flag("-V,--version", "skelgen " + std::string(version));
    app.require_subcommand(1);
    app.footer(footer());
    add_commands(app, argc > 1 ? argv[1] : "");
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& success) { // --help and --version
        app.exit(success);
        if (!std::cout.flush())
            throw Error(ErrorCode::not_written, "standard output: cannot be written; make room or send it elsewhere");
    } catch (const CLI::RuntimeError& ended) {
        return ended.get_exit_code();
    } catch (const CLI::ParseError& error) {
        print_usage_error(app, error, argc > 1 ? argv[1] : "");
        return exit_status(ErrorCode::usage);
    }
    return 0;
}

} // namespace

int run_program(int argc, char** argv) {
    try {
        return run(argc, argv);
    } catch (const Error& error) {
        print_error(error.what());
        return exit_status(error.code());
    } catch (const std::bad_alloc&) {
        print_error("out of memory; use a smaller mesh or a larger machine");
    } catch (const std::exception& error) {
        print_error(std::string("a fault of skelgen's own, please report it: ") + error.what());
    } catch (...) {
        print_error("a fault of skelgen's own of unknown kind, please report it");
    }
    return exit_status(ErrorCode::internal);
}

} // namespace skelgen::cli
