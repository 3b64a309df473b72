#include "batch_folder.hpp"

#include <map>
#include <set>
#include <system_error>

#include <skelgen/io/atomic_file.hpp>

#include "batch_parts.hpp"

namespace skelgen::cli {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> names(const std::vector<BatchItem>& items) {
    std::vector<std::string> files;
    files.reserve(items.size());
    for (const BatchItem& item : items) files.push_back(item.file);
    return files;
}

/// Removes further results that an earlier run says it has written.
void remove_parts(const BatchItem& item, const std::map<std::string, std::string>& written) {
    std::error_code error;
    for (const std::string& part : batch_part_names())
        if (written.contains(part)) fs::remove(part_file(item, part), error);
}

} // namespace

void start_over(const std::vector<BatchItem>& items, const BatchSummary& summary,
                const std::vector<std::string>& parts) {
    std::error_code error; // what cannot be removed cannot be replaced either: its mesh will fail
    const SummaryLines known = summary.read();
    for (const BatchItem& item : items) {
        fs::remove(item.output, error);
        for (const std::string& part : parts) fs::remove(part_file(item, part), error);
        if (const auto line = known.find(item.file); line != known.end()) remove_parts(item, line->second.also);
    }
    static_cast<void>(summary.update(names(items), {}));
}

void clean_up(const std::vector<BatchItem>& items, const fs::path& output_folder) {
    std::set<fs::path> folders;
    for (const BatchItem& item : items) {
        if (!folders.insert(item.output.parent_path()).second) continue;
        for (const std::string& part : batch_part_names()) folders.insert(part_file(item, part).parent_path());
    }
    folders.insert(output_folder);
    for (const fs::path& folder : folders) io::remove_leftovers(folder);
}

} // namespace skelgen::cli
