#include "batch_report.hpp"

#include <filesystem>

#include <skelgen/core/error.hpp>
#include <skelgen/io/read_file.hpp>
#include <skelgen/render/report_page.hpp>

#include "batch_parts.hpp"

namespace skelgen::cli {
namespace {

/// Empty where there is none: of what could not be read, or took too long.
std::string picture_of(const BatchItem& item, const SummaryLine& line) {
    const auto found = line.also.find("render");
    if (found == line.also.end() || !found->second.empty()) return "";
    try {
        return io::read_file(part_file(item, "render"));
    } catch (const Error&) { // taken away since
        return "";
    }
}

render::ReportEntry entry_of(const BatchItem& item, const SummaryLine& line) {
    render::ReportEntry entry;
    entry.file = item.file;
    entry.status = line.status;
    if (!line.error.empty()) entry.messages.push_back(line.error);
    for (const auto& [part, error] : line.also)
        if (!error.empty()) entry.messages.push_back(error);
    entry.warnings = line.warnings;
    entry.seconds = line.seconds;
    entry.faces = line.faces;
    entry.sides_confidence = line.sides_confidence;
    entry.least_confidence = line.least_confidence;
    entry.picture = picture_of(item, line);
    return entry;
}

} // namespace

std::string batch_report(const std::string& title, const std::vector<BatchItem>& items, const SummaryLines& lines) {
    std::vector<render::ReportEntry> entries;
    for (const BatchItem& item : items) {
        const auto line = lines.find(item.file);
        if (line != lines.end()) {
            entries.push_back(entry_of(item, line->second));
        } else {
            entries.emplace_back();
            entries.back().file = item.file;
            entries.back().status = "not done yet";
        }
    }
    return render::report_page(title, std::move(entries));
}

} // namespace skelgen::cli
