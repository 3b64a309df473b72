// Not tests but what they look at: see batch_results.hpp. (Only *_test.cpp files are built.)

#include "batch_results.hpp"

#include <regex>
#include <sstream>

#include "catch.hpp"
#include "run_cli.hpp"

namespace skelgen::test {

std::map<std::string, nlohmann::json> read_summary(const std::filesystem::path& folder) {
    std::map<std::string, nlohmann::json> lines;
    std::istringstream text(read_file(folder / "summary.jsonl"));
    for (std::string line; std::getline(text, line);) {
        const nlohmann::json json = nlohmann::json::parse(line);
        CHECK(lines.emplace(json.at("file"), json).second);
    }
    return lines;
}

std::map<std::string, std::string> statuses(const std::filesystem::path& folder) {
    std::map<std::string, std::string> all;
    for (const auto& [file, line] : read_summary(folder)) all[file] = line.at("status");
    return all;
}

std::map<std::string, std::string> results(const std::filesystem::path& folder) {
    static const std::regex times("\"timings_ms\": \\{[^}]*\\}|\"seconds\":[0-9.e+-]+");
    std::map<std::string, std::string> all;
    for (const std::string& file : files_below(folder))
        all[file] = std::regex_replace(read_file(folder / file), times, "");
    return all;
}

} // namespace skelgen::test
