#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "batch_inputs.hpp"
#include "batch_summary.hpp"

namespace skelgen::cli {

/// Files for all bodies of a batch together; empty: none, "-": standard output.
struct TableFiles {
    std::string csv, npz;
};

/// Adds the options --csv and --npz.
void add_table_options(CLI::App& command, TableFiles& files);

/// Those that are wanted.
[[nodiscard]] std::vector<std::string> files_of(const TableFiles& files);

/// Writes the tables that are wanted, a row for each mesh: the file, what became of it, its joints, and its measures
/// where the part measure was written. They are read from what the batch has written. \throws Error as `write_result`.
void write_tables(const TableFiles& files, const std::vector<BatchItem>& items, const SummaryLines& lines);

} // namespace skelgen::cli
