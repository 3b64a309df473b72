#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace skelgen::cli {

/// What became of one mesh of a batch.
struct SummaryLine {
    std::string file;   ///< BatchItem::file
    std::string status; ///< "ok", an error's code ("bad_input", "no_skeleton", ...), "timeout", "memory" or "crash"
    std::string error;  ///< one sentence; empty when all is well
    std::string code;   ///< why there is no skeleton, as a word: `to_string(Refusal)`; empty where that is not it
    double seconds = 0;
    std::int64_t faces = 0;
    std::vector<std::string> warnings;
    std::string input;  ///< `input_fingerprint` of what the skeleton was found in; empty where it could not be taken
    std::string output; ///< `result_fingerprint` of the skeleton's file; empty where there is none
    std::optional<double> sides_confidence;  ///< Quality::sides_confidence
    std::optional<double> least_confidence;  ///< of the joint that is least certain
    std::map<std::string, std::string> also; ///< by further result: why it could not be had; empty: it was written
};

/// By file.
using SummaryLines = std::map<std::string, SummaryLine>;

[[nodiscard]] std::string to_json(const SummaryLine& line);

/// \throws Error bad_input when `json` is no summary line.
[[nodiscard]] SummaryLine parse_summary_line(const std::string& json);

/// All that a summary says, in its order; of one file there may be several lines.
struct SummaryContent {
    std::vector<SummaryLine> lines;
    std::size_t unreadable = 0; ///< lines that are none, the last one that was cut off included
};

/// Reads a summary that no process writes to any more. \throws Error bad_input when it is no file or cannot be read.
[[nodiscard]] SummaryContent read_summary(const std::filesystem::path& file);

/// A folder's summary.jsonl. Several processes may work on it at a time, shards of one batch: every access locks it. It
/// survives their being killed at any moment: a line that was cut off is dropped at the next access.
class BatchSummary {
public:
    explicit BatchSummary(std::filesystem::path folder);

    /// Adds a line at the end, in one write. \throws Error with `io::write_error_code` when it cannot be written.
    void append(const SummaryLine& line) const;

    /// Removes the lines of `files` and puts `lines` in; then there is one line per file, the last one, ordered by
    /// file. Returns all that is in it. The file is replaced as a whole.
    /// \throws Error with `io::write_error_code` when it cannot be written.
    [[nodiscard]] SummaryLines update(const std::vector<std::string>& files,
                                      const std::vector<SummaryLine>& lines) const;

    /// One line per file, the last one.
    [[nodiscard]] SummaryLines read() const;

    [[nodiscard]] const std::filesystem::path& file() const { return file_; }

private:
    std::filesystem::path folder_;
    std::filesystem::path file_;
};

} // namespace skelgen::cli
