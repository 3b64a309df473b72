#include <exception>
#include <new>
#include <string>

#include <skelgen/version.hpp>

#include "commands.hpp"
#include "console.hpp"

namespace {

using skelgen::Error;
using skelgen::ErrorCode;

constexpr int to_status(ErrorCode code) { return static_cast<int>(code); }

void add_commands(CLI::App& app) {
    skelgen::add_extract_command(app);
    skelgen::add_batch_command(app);
    skelgen::add_evaluate_command(app);
    skelgen::add_curve_command(app);
    skelgen::add_render_command(app);
    skelgen::add_synth_command(app);
}

/// CLI11's own message in the shape of all others.
void print_usage_error(const CLI::App& app, const CLI::ParseError& error, const std::string& first_argument) {
    const auto commands = app.get_subcommands();
    const bool is_unknown_command = commands.empty() && !first_argument.empty() && first_argument.front() != '-';
    std::string subject = is_unknown_command ? first_argument : "command line";
    std::string what = is_unknown_command ? "is no command of skelgen" : error.what();
    std::string help = "skelgen --help";
    if (!commands.empty()) {
        subject = commands.front()->get_name();
        help = "skelgen " + subject + " --help";
    }
    skelgen::cli::print_error(subject + ": " + what + "; see `" + help + "`");
}

int run(int argc, char** argv) {
    CLI::App app("The kinematic skeleton of a human body, found in its triangle mesh by geometry alone.", "skelgen");
    app.set_version_flag("--version", "skelgen " + std::string(skelgen::version));
    app.require_subcommand(1);
    app.footer("Example:\n  skelgen extract body.off -o body.json\n\n"
               "Exit status: 0 done; 1 a fault of skelgen's own; 2 wrong usage; 3 the input cannot be read or is no\n"
               "mesh; 4 no skeleton could be found in it; 5 (batch) some meshes failed.");
    add_commands(app);
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& success) { // --help and --version
        return app.exit(success);
    } catch (const CLI::RuntimeError& ended) {
        return ended.get_exit_code();
    } catch (const CLI::ParseError& error) {
        print_usage_error(app, error, argc > 1 ? argv[1] : "");
        return to_status(ErrorCode::usage);
    }
    return 0;
}

} // namespace

int main(int argc, char** argv) {
    try {
        return run(argc, argv);
    } catch (const Error& error) {
        skelgen::cli::print_error(error.what());
        return to_status(error.code());
    } catch (const std::bad_alloc&) {
        skelgen::cli::print_error("out of memory; use a smaller mesh or a larger machine");
    } catch (const std::exception& error) {
        skelgen::cli::print_error(std::string("a fault of skelgen's own, please report it: ") + error.what());
    } catch (...) {
        skelgen::cli::print_error("a fault of skelgen's own of unknown kind, please report it");
    }
    return to_status(ErrorCode::internal);
}
