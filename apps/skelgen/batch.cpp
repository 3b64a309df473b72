#include <algorithm>
#include <cstdio>
#include <memory>
#include <new>
#include <sstream>
#include <thread>

#include <skelgen/io/atomic_file.hpp>

#include "batch_folder.hpp"
#include "batch_inputs.hpp"
#include "batch_parts.hpp"
#include "batch_summary.hpp"
#include "batch_table.hpp"
#include "commands.hpp"
#include "console.hpp"
#include "extract_file.hpp"
#include "fingerprint.hpp"
#include "number_range.hpp"
#include "progress_bar.hpp"
#include "worker_pool.hpp"

#if SKELGEN_WITH_RENDER
#include "batch_report.hpp"
#endif

namespace skelgen::cli {
namespace {

namespace fs = std::filesystem;

struct BatchCommand {
    std::vector<std::string> inputs;
    std::string output_folder;
    std::string skeleton_template = "human21";
    std::string shard = "1/1";
    std::string also;       ///< further results, as `parse_batch_parts` takes them
    fs::path template_body; ///< whose vertices the part correspond looks for; empty: none
    std::string report;     ///< page to write; empty: none
    TableFiles tables;
    std::size_t jobs = std::max(1U, std::thread::hardware_concurrency());
    double timeout_seconds = 600;
    std::size_t memory = 0; ///< mebibytes
    bool resume = false;
    bool quiet = false;
};

// --------------------------------------------------------------------------------------------- in a worker process

std::string to_text(double number) {
    std::ostringstream text;
    text << number;
    return text.str();
}

/// `extract_file`; where it takes too much memory, `line` gets the status that says so.
FileExtraction extract_within_memory(const BatchItem& item, const ExtractOptions& options, std::size_t mebibytes,
                                     SummaryLine& line) {
    try {
        return extract_file({item.mesh, {}}, options);
    } catch (const std::bad_alloc&) {
        if (mebibytes == 0) throw;
        line.status = "memory";
        throw Error(ErrorCode::internal, "needs more memory than --memory " + std::to_string(mebibytes) +
                                             " MiB; use a smaller mesh or a larger --memory");
    }
}

/// What all meshes of a batch are worked on with.
struct Background {
    ExtractOptions options;
    PartContext parts;
    std::string template_body; ///< its fingerprint; empty: there is none
    std::size_t mebibytes = 0;
};

/// Of all that a mesh's results depend on.
std::string fingerprint_of(const BatchItem& item, const Background& background) {
    const std::string input = input_fingerprint(item.mesh, background.options.skeleton_template);
    const std::string beside = background.template_body + (background.options.or_quadruped ? "auto" : "");
    return input.empty() || beside.empty() ? input : fingerprint(input + beside);
}

/// Writes the further results; what fails costs itself alone. The reasons, empty where there is none, and what else is
/// to be said of them goes into the line.
void write_parts(const BatchItem& item, const FileExtraction& found, const PartContext& context,
                 const std::vector<std::string>& parts, SummaryLine& line) {
    for (const std::string& part : parts) {
        std::string& fault = line.also[part];
        try {
            std::string warning = write_part(part, item, found, context);
            if (!warning.empty()) line.warnings.push_back(std::move(warning));
        } catch (const Error& error) {
            fault = error.what() + (" (--also " + part + ")");
        }
    }
}

/// Draws a refused mesh where pictures are wanted; what cannot be drawn has its reason for that in the summary already.
std::map<std::string, std::string> draw_failure(const BatchItem& item, const std::vector<std::string>& parts,
                                                const Error& reason) {
    if (reason.code() != ErrorCode::no_skeleton || std::find(parts.begin(), parts.end(), "render") == parts.end())
        return {};
    try {
        draw_refused(item, reason.what());
        return {{"render", ""}};
    } catch (const Error& error) {
        return {{"render", error.what()}};
    }
}

double least_confidence(const KinematicSkeleton<double>& skeleton) {
    double least = 1;
    for (const Joint<double>& joint : skeleton.joints) least = std::min(least, joint.confidence);
    return least;
}

/// Extracts one mesh to its output file.
SummaryLine process(const BatchItem& item, const Background& background, const std::vector<std::string>& parts) {
    SummaryLine line;
    line.file = item.file;
    try {
        if (!item.fault.empty()) throw Error(ErrorCode::bad_input, item.mesh.string() + ": " + item.fault);
        const std::string input = fingerprint_of(item, background);
        const FileExtraction result = in_file(
            item.mesh, [&] { return extract_within_memory(item, background.options, background.mebibytes, line); });
        make_folder(item.output.parent_path());
        in_file(item.output, [&] { io::write_file_atomically(item.output, result.json); });
        line.status = "ok";
        line.faces = result.provenance.mesh->faces;
        const KinematicSkeleton<double>& skeleton = result.skeleton();
        line.warnings = skeleton.quality.warnings;
        line.sides_confidence = skeleton.quality.sides_confidence;
        line.least_confidence = least_confidence(skeleton);
        line.input = input;
        line.output = result_fingerprint(skeleton, result.provenance.mesh);
        write_parts(item, result, background.parts, parts, line);
    } catch (const Error& error) {
        if (line.status.empty()) line.status = to_string(error.code());
        line.error = error.what();
        if (error.refusal() != Refusal::none) line.code = to_string(error.refusal());
        line.also = draw_failure(item, parts, error);
    }
    return line;
}

// ---------------------------------------------------------------------------------------------- before and after

/// Whether an earlier run has found the skeleton in what the mesh is now, with the same template and the same skelgen,
/// its file is still as it was written, and the further results are there. One that was killed between a skeleton and
/// its line has to find it again.
bool is_done(const BatchItem& item, const SummaryLine& line, const Background& background,
             const std::vector<std::string>& parts) {
    const bool has_parts = std::all_of(parts.begin(), parts.end(), [&](const std::string& part) {
        const auto known = line.also.find(part);
        return known != line.also.end() && known->second.empty() && fs::exists(part_file(item, part));
    });
    return has_parts && line.status == "ok" && !line.input.empty() && !line.output.empty() &&
           line.output == result_fingerprint(item.output) && line.input == fingerprint_of(item, background);
}

/// Brings the summary in order after a run that was cut off. Returns the items still to be done.
std::vector<BatchItem> resume(const std::vector<BatchItem>& items, const BatchSummary& summary,
                              const Background& background, const std::vector<std::string>& parts) {
    const SummaryLines known = summary.read();
    std::vector<BatchItem> left;
    for (const BatchItem& item : items) {
        const auto line = known.find(item.file);
        if (line == known.end() || !is_done(item, line->second, background, parts)) left.push_back(item);
    }
    start_over(left, summary, parts);
    return left;
}

// -------------------------------------------------------------------------------------------------- while it runs

/// Takes down what becomes of each mesh.
class Recorder {
public:
    Recorder(const std::vector<BatchItem>& items, const BatchSummary& summary, const BatchCommand& command,
             const std::vector<std::string>& parts)
        : items_(items), summary_(summary), parts_(parts), timeout_seconds_(command.timeout_seconds),
          memory_(command.memory), bar_(items.size(), !command.quiet) {
        bar_.show(0, 0);
    }

    void record(std::size_t index, const JobOutcome& outcome) {
        const SummaryLine line = to_line(items_[index], outcome);
        if (line.status != "ok") take_failure(items_[index], line);
        take_failed_parts(line);
        summary_.append(line);
        bar_.show(++done_, failed_);
    }

    [[nodiscard]] std::size_t done() const { return done_; }
    [[nodiscard]] std::size_t failed() const { return failed_; }
    [[nodiscard]] std::size_t failed_parts() const { return failed_parts_; }
    void clear_bar() const { bar_.clear(); }

private:
    [[nodiscard]] SummaryLine to_line(const BatchItem& item, const JobOutcome& outcome) const {
        SummaryLine line;
        line.file = item.file;
        line.seconds = outcome.seconds;
        switch (outcome.end) {
        case JobEnd::done:
            line = parse_summary_line(outcome.result);
            line.seconds = outcome.seconds;
            break;
        case JobEnd::crashed:
            line.status = "crash";
            line.error = item.mesh.string() + ": " + outcome.result +
                         (memory_ > 0 ? "; --memory may be too small for it, or" : ";") +
                         " a fault of skelgen's own, please report it";
            break;
        case JobEnd::timed_out:
            line.status = "timeout";
            line.error = item.mesh.string() + ": took longer than " + to_text(timeout_seconds_) +
                         " s; use a smaller mesh or a longer --timeout";
            break;
        }
        return line;
    }

    void take_failure(const BatchItem& item, const SummaryLine& line) {
        ++failed_;
        std::error_code error;
        fs::remove(item.output, error); // a worker may have been killed just after it wrote the file
        for (const std::string& part : parts_)
            if (!line.also.contains(part)) fs::remove(part_file(item, part), error);
        io::remove_leftovers(item.output.parent_path());
        bar_.clear();
        print_error(line.error);
    }

    void take_failed_parts(const SummaryLine& line) {
        for (const auto& [part, fault] : line.also) {
            if (fault.empty()) continue;
            ++failed_parts_;
            bar_.clear();
            print_error(fault);
        }
    }

    const std::vector<BatchItem>& items_;
    const BatchSummary& summary_;
    const std::vector<std::string>& parts_;
    double timeout_seconds_;
    std::size_t memory_;
    ProgressBar bar_;
    std::size_t done_ = 0;
    std::size_t failed_ = 0;
    std::size_t failed_parts_ = 0;
};

/// The further results that are wanted; a report shows pictures, a table the measures that bodies of human21 have.
std::vector<std::string> parts_of(const BatchCommand& command, const SkeletonTemplate& skeleton_template) {
    std::vector<std::string> parts = parse_batch_parts(command.also);
    const auto add = [&](const char* part) {
        if (std::find(parts.begin(), parts.end(), part) == parts.end()) parts.emplace_back(part);
    };
    if (!command.report.empty()) add("render");
    if (!files_of(command.tables).empty() && skeleton_template.name == "human21") add("measure");
    return parts;
}

/// Results of all meshes together.
std::vector<std::string> files_beside(const BatchCommand& command) {
    std::vector<std::string> files = files_of(command.tables);
    if (!command.report.empty()) files.push_back(command.report);
    return files;
}

/// What these must not replace, and themselves; nothing where no file is to be written.
std::vector<fs::path> own_files(const BatchCommand& command, const BatchSummary& summary) {
    std::vector<fs::path> files;
    for (const std::string& file : files_beside(command))
        if (file != "-") files.emplace_back(file);
    if (!files.empty()) files.insert(files.begin(), summary.file());
    return files;
}

/// What the meshes are worked on with. \throws Error as `load_template`, `fit_file` and `compared`.
Background background_of(const BatchCommand& command) {
    Background out;
    want_template(out.options, command.skeleton_template);
    out.parts.skeleton_template = out.options.skeleton_template;
    out.mebibytes = command.memory;
    const std::vector<std::string> parts = parse_batch_parts(command.also);
    const bool corresponds = std::find(parts.begin(), parts.end(), "correspond") != parts.end();
    if (corresponds == command.template_body.empty())
        throw Error(ErrorCode::usage, corresponds ? "--also correspond: name the body whose vertices are looked for "
                                                    "with --template-body"
                                                  : "--template-body: goes with --also correspond");
    if (!corresponds) return out;
    in_file(command.template_body, [&] { out.parts.template_body = compared(fit_file({command.template_body, {}})); });
    out.template_body = input_fingerprint(command.template_body, out.options.skeleton_template);
    return out;
}

#if SKELGEN_WITH_RENDER
void write_report(const BatchCommand& command, const std::vector<BatchItem>& items, const SummaryLines& lines) {
    write_result(command.report, batch_report("skelgen batch: " + command.output_folder, items, lines));
}
#else
void write_report(const BatchCommand&, const std::vector<BatchItem>&, const SummaryLines&) {}
#endif

/// Returns the exit status.
int run(const BatchCommand& command) {
    Background background = background_of(command);
    const fs::path folder = command.output_folder;
    const auto all = find_batch_items(command.inputs, folder);
    const auto items = take_shard(all, parse_shard(command.shard));
    const std::vector<std::string> parts = parts_of(command, background.options.skeleton_template);
    background.options.with_curve = std::any_of(parts.begin(), parts.end(), part_has_curve);
    const BatchSummary summary(folder);
    for (const std::string& file : files_beside(command))
        for (const BatchItem& item : all) require_different_files(item.mesh, file);
    require_own_files(all, parts, own_files(command, summary));
    make_folder(folder);
    for (const std::string& file : files_beside(command)) require_folder_of(file);
    clean_up(items, folder);

    std::vector<BatchItem> left = items;
    if (command.resume)
        left = resume(items, summary, background, parts);
    else
        start_over(items, summary, parts);

    Recorder recorder(left, summary, command, parts);
    const int signal = run_in_workers(
        left.size(), {command.jobs, command.timeout_seconds, command.memory << 20U},
        [&](std::size_t i) { return to_json(process(left[i], background, parts)); },
        [&](std::size_t i, const JobOutcome& outcome) { recorder.record(i, outcome); });

    recorder.clear_bar();
    clean_up(left, folder);
    const SummaryLines lines = summary.update({}, {});
    if (!command.report.empty()) write_report(command, all, lines);
    write_tables(command.tables, all, lines);
    const std::string failed_parts =
        recorder.failed_parts() > 0 ? ", " + std::to_string(recorder.failed_parts()) + " further results failed" : "";
    if (!command.quiet)
        std::fprintf(stderr, "%zu meshes: %zu done now, %zu done before, %zu failed%s%s; see %s\n", items.size(),
                     recorder.done() - recorder.failed(), items.size() - left.size(), recorder.failed(),
                     failed_parts.c_str(), signal != 0 ? ", the rest interrupted (continue with --resume)" : "",
                     summary.file().c_str());
    if (signal != 0) return 128 + signal; // as shells tell it
    return recorder.failed() + recorder.failed_parts() > 0 ? status_some_failed : 0;
}

} // namespace

void add_batch_command(CLI::App& app) {
    auto command = std::make_shared<BatchCommand>();
    CLI::App* sub = app.add_subcommand("batch", "Find the skeletons in many meshes");
    sub->add_option("INPUT", command->inputs, "Meshes, folders of meshes, or quoted patterns such as 'scans/**/*.ply'")
        ->required();
    sub->add_option("-o,--output", command->output_folder, "Folder to write <relative path>.json and summary.jsonl to")
        ->required()
        ->type_name("DIR");
    sub->add_option("--jobs", command->jobs, "Meshes at a time")
        ->check(CLI::Range(std::size_t{1}, std::size_t{1024}))
        ->capture_default_str();
    sub->add_flag("--resume", command->resume,
                  "Leave out what an earlier run has done and what has not changed since; try again what has failed");
    sub->add_option("--also", command->also,
                    "Further results, separated by commas, each into a folder of its name in DIR: " +
                        batch_parts_text())
        ->type_name("PART,...");
    sub->add_option("--template-body", command->template_body, "Mesh of the body for --also correspond, found once")
        ->type_name("FILE");
    add_table_options(*sub, command->tables);
#if SKELGEN_WITH_RENDER
    sub->add_option("--report", command->report,
                    "Page to write (HTML, one file): pictures, failures first, times, confidences; filter and sort")
        ->type_name("FILE");
#endif
    sub->add_option("--shard", command->shard,
                    "Do part K of N only, for several machines: each into a folder of its own; see merge")
        ->type_name("K/N");
    sub->add_option("--timeout", command->timeout_seconds, "Seconds after which a mesh is given up; 0: never")
        ->check(number_range(0, 1e9))
        ->capture_default_str();
    sub->add_option("--memory", command->memory, "Mebibytes of memory that each worker may take; 0: no limit")
        ->check(CLI::Range(std::size_t{0}, std::size_t{1} << 40U))
        ->capture_default_str();
    sub->add_option(
           "--template", command->skeleton_template,
           "Built-in template (human21, pinocchio18, quadruped), auto for a person or a four-legged animal, or a "
           "template's file (JSON)")
        ->capture_default_str();
    sub->add_flag("-q,--quiet", command->quiet, "No progress bar and no closing line");
    sub->footer("Examples:\n"
                "  skelgen batch scans/ -o skeletons/ --jobs 8\n"
                "  skelgen batch scans/ -o skeletons/ --resume\n"
                "  skelgen batch scans/ -o bodies/ --also rig,measure --report bodies/report.html\n"
                "  skelgen batch scans/ -o bodies/ --csv bodies.csv\n"
                "  skelgen batch scans/ -o bodies/ --also correspond --template-body template.obj\n"
                "  skelgen batch 'scans/*.ply' -o skeletons/ --shard 2/4");
    sub->callback([command] {
        if (const int status = run(*command)) throw CLI::RuntimeError(status);
    });
}

} // namespace skelgen::cli
