#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include <skelgen/io/atomic_file.hpp>
#include <skelgen/io/read_file.hpp>

#include "batch_folder.hpp"
#include "batch_inputs.hpp"
#include "batch_parts.hpp"
#include "batch_summary.hpp"
#include "batch_table.hpp"
#include "commands.hpp"
#include "console.hpp"
#include "merge_shards.hpp"
#include "progress_bar.hpp"

#if SKELGEN_WITH_RENDER
#include "batch_report.hpp"
#endif

namespace skelgen::cli {
namespace {

namespace fs = std::filesystem;

struct MergeCommand {
    std::vector<std::string> shards;
    std::vector<std::string> meshes;
    std::string output_folder;
    std::string report; ///< page to write; empty: none
    TableFiles tables;
    bool quiet = false;
};

/// Each folder once; what it says.
std::vector<ShardFolder> read_shards(const MergeCommand& command) {
    std::vector<fs::path> places;
    std::vector<ShardFolder> shards;
    for (const std::string& folder : command.shards) {
        const fs::path place = place_of(fs::path(folder) / "");
        if (place == place_of(fs::path(command.output_folder) / ""))
            throw Error(ErrorCode::usage, folder + ": is a shard's folder; choose another one with -o");
        if (std::find(places.begin(), places.end(), place) != places.end()) continue;
        places.push_back(place);
        shards.push_back({folder, read_summary(fs::path(folder) / "summary.jsonl")});
    }
    return shards;
}

/// Further results that any shard tells of.
std::vector<std::string> parts_in(const std::vector<ShardFolder>& shards) {
    std::vector<std::string> parts;
    for (const std::string& part : batch_part_names()) {
        const auto has_part = [&](const SummaryLine& line) { return line.also.contains(part); };
        if (std::any_of(shards.begin(), shards.end(), [&](const ShardFolder& shard) {
                return std::any_of(shard.summary.lines.begin(), shard.summary.lines.end(), has_part);
            }))
            parts.push_back(part);
    }
    return parts;
}

/// The same file at another place: a second name of it, or a copy where there can be none, as on another disk.
void link_or_copy(const fs::path& from, const fs::path& to) {
    std::error_code error;
    fs::create_hard_link(from, to, error);
    if (!error) return;
    const std::string content = in_file(from, [&] { return io::read_file(from); });
    in_file(to, [&] { io::write_file_atomically(to, content); });
}

/// Puts a mesh's results into the output folder, where `item` has them; returns its line. Further results that are
/// there no more have their reason in it.
SummaryLine gather(const BatchItem& item, const fs::path& relative_output, const MergedMesh& mesh) {
    SummaryLine line = mesh.line;
    if (mesh.shard.empty()) return line;
    BatchItem source = item;
    source.output = mesh.shard / relative_output;
    source.folder = mesh.shard;
    make_folder(item.output.parent_path());
    if (line.status == "ok") link_or_copy(source.output, item.output);
    for (auto& [part, error] : line.also) {
        const auto& known = batch_part_names(); // a summary may say anything
        if (!error.empty() || std::find(known.begin(), known.end(), part) == known.end()) continue;
        const fs::path file = part_file(source, part);
        std::error_code gone;
        if (fs::is_regular_file(file, gone)) {
            make_folder(part_file(item, part).parent_path());
            link_or_copy(file, part_file(item, part));
        } else
            error = file.string() + ": is not there any more; run its shard again with --resume, and merge again";
    }
    return line;
}

/// Tells of the first ones and counts the rest: there may be a million.
void print_all(const std::vector<std::string>& messages, const std::string& rest, void (*print)(std::string_view)) {
    constexpr std::size_t most = 20;
    for (std::size_t i = 0; i < std::min(most, messages.size()); ++i) print(messages[i]);
    if (messages.size() > most) print(std::to_string(messages.size() - most) + " more " + rest);
}

std::string repeated_text(const MergedMesh& mesh) {
    std::string text = mesh.line.file + ": is in several lines of the summaries, of";
    for (const fs::path& shard : mesh.repeated) text += " " + shard.string();
    return text;
}

/// How many meshes came to what, and what is to be said of them.
struct Account {
    std::size_t done = 0;
    std::size_t missing = 0;
    std::size_t contradictions = 0;
    std::size_t failed = 0;
    std::size_t failed_parts = 0;
    std::vector<std::string> errors;
    std::vector<std::string> repeated;

    [[nodiscard]] bool is_all_done() const { return missing + contradictions + failed + failed_parts == 0; }
};

Account account_of(const std::vector<SummaryLine>& lines, const std::vector<MergedMesh>& meshes) {
    Account account;
    for (const SummaryLine& line : lines) {
        if (line.status == "ok")
            ++account.done;
        else if (line.status == status_missing)
            ++account.missing;
        else if (line.status == status_contradiction)
            ++account.contradictions;
        else
            ++account.failed;
        if (line.status != "ok") account.errors.push_back(line.error);
        for (const auto& [part, error] : line.also) {
            if (error.empty()) continue;
            ++account.failed_parts;
            account.errors.push_back(error);
        }
    }
    for (const MergedMesh& mesh : meshes)
        if (!mesh.repeated.empty()) account.repeated.push_back(repeated_text(mesh));
    return account;
}

void print_account(const Account& account, const std::vector<std::string>& strangers, const fs::path& summary) {
    print_all(account.errors, "of this kind; all are in " + summary.string(), print_error);
    print_all(strangers, "such lines", [](std::string_view line) {
        print_error(std::string(line) + ": is none of these meshes; its shard is of another run, or the mesh is gone");
    });
    print_all(account.repeated, "such meshes", print_warning);
}

void print_shards(const std::vector<ShardFolder>& shards) {
    for (const ShardFolder& shard : shards)
        if (shard.summary.unreadable > 0)
            print_warning((shard.folder / "summary.jsonl").string() + ": " + std::to_string(shard.summary.unreadable) +
                          " of its lines cannot be read, as those of processes that were killed");
}

#if SKELGEN_WITH_RENDER
void write_report(const MergeCommand& command, const std::vector<BatchItem>& items, const SummaryLines& lines) {
    write_result(command.report, batch_report("skelgen merge: " + command.output_folder, items, lines));
}
#else
void write_report(const MergeCommand&, const std::vector<BatchItem>&, const SummaryLines&) {}
#endif

/// Returns the exit status.
int run(const MergeCommand& command) {
    const fs::path folder = command.output_folder;
    const auto relative = find_batch_items(command.meshes, {});
    const auto items = find_batch_items(command.meshes, folder);
    std::vector<std::string> beside = files_of(command.tables);
    if (!command.report.empty()) beside.push_back(command.report);
    for (const std::string& file : beside)
        for (const BatchItem& item : items) require_different_files(item.mesh, file);
    const std::vector<ShardFolder> shards = read_shards(command);
    const BatchSummary summary(folder);
    std::vector<fs::path> own(beside.begin(), beside.end());
    if (!own.empty()) own.push_back(summary.file());
    require_own_files(items, parts_in(shards), own);
    print_shards(shards);

    const auto merged = [&] {
        ProgressBar bar(items.size(), !command.quiet, patience_seconds);
        return merge_shards(relative, shards, [&](std::size_t done) { bar.show(done, 0); });
    }();
    make_folder(folder);
    for (const std::string& file : beside) require_folder_of(file);
    clean_up(items, folder);
    start_over(items, summary, {});
    std::vector<SummaryLine> lines;
    {
        ProgressBar bar(items.size(), !command.quiet, patience_seconds);
        for (std::size_t i = 0; i < items.size(); ++i) {
            lines.push_back(gather(items[i], relative[i].output, merged.meshes[i]));
            bar.show(lines.size(), 0);
        }
    }
    const SummaryLines all = summary.update({}, lines);
    if (!command.report.empty()) write_report(command, items, all);
    write_tables(command.tables, items, all);

    const Account account = account_of(lines, merged.meshes);
    print_account(account, merged.strangers, summary.file());
    if (!command.quiet)
        std::fprintf(stderr,
                     "%zu meshes in %zu shards: %zu done, %zu failed, %zu missing, %zu contradictory, %zu done twice; "
                     "see %s\n",
                     items.size(), shards.size(), account.done, account.failed, account.missing, account.contradictions,
                     account.repeated.size(), summary.file().c_str());
    return account.is_all_done() && merged.strangers.empty() ? 0 : status_some_failed;
}

} // namespace

void add_merge_command(CLI::App& app) {
    auto command = std::make_shared<MergeCommand>();
    CLI::App* sub = app.add_subcommand("merge", "Join what the shards of a batch have done");
    sub->add_option("SHARD", command->shards, "Folders that shards were written to (batch --shard K/N -o SHARD)")
        ->required()
        ->type_name("DIR");
    sub->add_option("--meshes", command->meshes, "What was given to batch: meshes, folders, quoted patterns")
        ->required()
        ->type_name("INPUT");
    sub->add_option("-o,--output", command->output_folder,
                    "Folder for all results, as one batch had written them; hard links where there can be such")
        ->required()
        ->type_name("DIR");
#if SKELGEN_WITH_RENDER
    sub->add_option(
           "--report", command->report,
           "Page to write (HTML, one file): failures first, times, confidences, pictures where shards drew any")
        ->type_name("FILE");
#endif
    add_table_options(*sub, command->tables);
    sub->add_flag("-q,--quiet", command->quiet, "No progress bar and no closing line");
    sub->footer(
        "Examples:\n"
        "  skelgen batch scans/ -o shards/2 --shard 2/4\n"
        "  skelgen merge shards/* --meshes scans/ -o skeletons/ --report report.html\n\n"
        "Meshes that no shard tells of, or whose skeleton is not there as it was written, are missing. Those\n"
        "that several lines tell of are named; where their skeletons differ they are left out. Meshes are\n"
        "not read: `skelgen batch INPUT -o DIR --resume` does what is missing, and again what has changed since.\n\n"
        "Exit status: 0 all done; 5 some meshes failed, are missing or contradictory.");
    sub->callback([command] {
        if (const int status = run(*command)) throw CLI::RuntimeError(status);
    });
}

} // namespace skelgen::cli
