// skelgen-regress EXPECTED FOLDER [--update]: makes synthetic bodies in FOLDER, extracts their skeletons and compares
// the scores with the expected ones. Exit status 0: as good; 1: something is worse.

#include <exception>
#include <iostream>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "bodies.hpp"
#include "scores.hpp"

namespace {

namespace fs = std::filesystem;
using namespace skelgen::regression;

struct Options {
    std::string expected;
    std::string folder;
    bool update = false;
    bool reuse_bodies = false;
    unsigned jobs = 1;
};

void print(const char* title, const std::vector<std::string>& lines) {
    if (lines.empty()) return;
    std::cout << '\n' << title << '\n';
    for (const std::string& line : lines) std::cout << "  " << line << '\n';
}

int update(const Options& options, const Results& found) {
    Expectations expectations{{0, 0.002, 0.01}, {}};
    if (fs::exists(options.expected)) expectations = read_expectations(options.expected);
    const std::vector<std::string> moved = moves(expectations.sets, found);
    print("what moved:", moved);
    if (moved.empty()) std::cout << "\nnothing moved\n";
    expectations.sets = found;
    write_expectations(options.expected, expectations);
    return 0;
}

int compare(const Options& options, const Results& found) {
    const Expectations expectations = read_expectations(options.expected);
    print("what moved:", moves(expectations.sets, found));
    const std::vector<std::string> worse = regressions(expectations, found);
    print("WORSE than expected by more than the tolerance:", worse);
    if (!worse.empty()) std::cout << "\nif that is wanted: ./dev regress --update\n";
    return worse.empty() ? 0 : 1;
}

int run(const Options& options) {
    const fs::path folder = options.folder;
    if (!options.reuse_bodies || !has_bodies(folder)) make_bodies(folder, options.jobs);
    const Results found = measure(folder, options.jobs);
    std::cout << to_table(found);
    return options.update ? update(options, found) : compare(options, found);
}

} // namespace

int main(int argc, char** argv) {
    Options options;
    CLI::App app("Scores the extraction on synthetic bodies against the expected scores.", "skelgen-regress");
    app.add_option("EXPECTED", options.expected, "JSON with the expected scores")->required();
    app.add_option("FOLDER", options.folder, "Where bodies and skeletons go")->required();
    app.add_flag("--update", options.update, "Make the scores found the expected ones");
    app.add_flag("--reuse-bodies", options.reuse_bodies,
                 "Take the last run's bodies: where the extraction alone changed");
    app.add_option("--jobs", options.jobs, "Bodies at once")->check(CLI::Range(1U, 256U));
    CLI11_PARSE(app, argc, argv);
    try {
        return run(options);
    } catch (const std::exception& error) {
        std::cerr << "skelgen-regress: error: " << error.what() << '\n';
        return 1;
    }
}
