#pragma once

// What skelgen batch and skelgen merge leave behind.

#include <filesystem>
#include <map>
#include <string>

#include <nlohmann/json.hpp>

namespace skelgen::test {

/// summary.jsonl by file; fails the test if a file has two lines or a line is no JSON.
[[nodiscard]] std::map<std::string, nlohmann::json> read_summary(const std::filesystem::path& folder);

/// The status of each file in summary.jsonl.
[[nodiscard]] std::map<std::string, std::string> statuses(const std::filesystem::path& folder);

/// The files below an output folder and what they hold, less what differs from run to run.
[[nodiscard]] std::map<std::string, std::string> results(const std::filesystem::path& folder);

} // namespace skelgen::test
