#include "merge_shards.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>

#include <skelgen/core/error.hpp>
#include <skelgen/io/skeleton_json.hpp>

#include "fingerprint.hpp"

namespace skelgen::cli {
namespace {

namespace fs = std::filesystem;

/// A line and the shard that it is of.
struct ShardLine {
    const ShardFolder* shard;
    const SummaryLine* line;
};

using LinesByFile = std::map<std::string_view, std::vector<ShardLine>>;

/// Of what an earlier merge could not find nothing has been done.
bool tells_of_work(const SummaryLine& line) {
    return line.status != status_missing && line.status != status_contradiction;
}

LinesByFile lines_by_file(const std::vector<ShardFolder>& shards) {
    LinesByFile by_file;
    for (const ShardFolder& shard : shards)
        for (const SummaryLine& line : shard.summary.lines)
            if (tells_of_work(line)) by_file[line.file].push_back({&shard, &line});
    return by_file;
}

/// Of each shard the last line, which is what the shard itself goes by.
std::vector<ShardLine> last_lines(const std::vector<ShardLine>& lines) {
    std::vector<ShardLine> last;
    for (const ShardLine& line : lines) {
        if (!last.empty() && last.back().shard == line.shard) last.pop_back();
        last.push_back(line);
    }
    return last;
}

/// The template of the skeleton that the line tells of; none where its file is not there as it was written.
std::optional<std::string> template_of(const ShardLine& found, const BatchItem& item) {
    const fs::path file = found.shard->folder / item.output;
    std::error_code error;
    if (found.line->output.empty() || !fs::is_regular_file(file, error)) return std::nullopt;
    try {
        const io::SkeletonDocument document = io::read_skeleton_document(file);
        if (result_fingerprint(document.skeleton, document.provenance.mesh) != found.line->output) return std::nullopt;
        return document.skeleton.template_name;
    } catch (const Error&) { // cut off, or something else by now
        return std::nullopt;
    }
}

bool have_one_result(const std::vector<ShardLine>& lines) {
    return std::all_of(lines.begin(), lines.end(), [&](const ShardLine& each) {
        return each.line->output == lines.front().line->output && each.line->input == lines.front().line->input;
    });
}

SummaryLine fault(const BatchItem& item, const char* status, const std::string& what) {
    SummaryLine line;
    line.file = item.file;
    line.status = status;
    line.error = item.mesh.string() + ": " + what;
    return line;
}

MergedMesh join(const BatchItem& item, const std::vector<ShardLine>& last) {
    constexpr const char* what_to_do = "; run its shard again with --resume, and merge again";
    MergedMesh merged;
    std::vector<ShardLine> sound;
    const ShardLine *failed = nullptr, *lost = nullptr;
    for (const ShardLine& each : last) {
        if (each.line->status != "ok") {
            if (failed == nullptr) failed = &each;
        } else if (const auto skeleton_template = template_of(each, item)) {
            if (sound.empty()) merged.skeleton_template = *skeleton_template;
            sound.push_back(each);
        } else {
            lost = &each;
        }
    }
    if (!sound.empty() && !have_one_result(sound)) {
        merged.skeleton_template.clear();
        merged.line = fault(item, status_contradiction,
                            "its skeletons in " + sound.front().shard->folder.string() + " and " +
                                sound.back().shard->folder.string() +
                                " differ; leave out the shard that is of another run, or whose mesh has changed since");
    } else if (!sound.empty() || (failed != nullptr && lost == nullptr)) {
        const ShardLine& taken = sound.empty() ? *failed : sound.front();
        merged.line = *taken.line;
        merged.shard = taken.shard->folder;
    } else if (lost != nullptr) {
        merged.line =
            fault(item, status_missing,
                  "its skeleton in " + lost->shard->folder.string() + " is not there as it was written" + what_to_do);
    } else {
        merged.line = fault(item, status_missing, std::string("is in no shard's summary") + what_to_do);
    }
    return merged;
}

void require_one_batch(const std::vector<BatchItem>& items, const std::vector<ShardFolder>& shards) {
    std::set<std::string_view> files;
    for (const BatchItem& item : items) files.insert(item.file);
    for (const ShardFolder& shard : shards) {
        const auto& lines = shard.summary.lines;
        const bool is_known =
            std::any_of(lines.begin(), lines.end(), [&](const SummaryLine& line) { return files.contains(line.file); });
        if (!lines.empty() && !is_known)
            throw Error(ErrorCode::bad_input, shard.folder.string() +
                                                  ": tells of none of these meshes but of others, such as " +
                                                  lines.front().file + "; leave it out, or correct --meshes");
    }
}

void require_one_template(const std::vector<MergedMesh>& meshes) {
    const MergedMesh* first = nullptr;
    for (const MergedMesh& mesh : meshes) {
        if (mesh.skeleton_template.empty()) continue;
        if (first == nullptr) first = &mesh;
        if (mesh.skeleton_template != first->skeleton_template)
            throw Error(ErrorCode::bad_input, mesh.shard.string() + ": has skeletons of the template " +
                                                  mesh.skeleton_template + ", " + first->shard.string() + " of " +
                                                  first->skeleton_template + "; merge shards of one batch");
    }
}

} // namespace

MergedShards merge_shards(const std::vector<BatchItem>& items, const std::vector<ShardFolder>& shards,
                          const std::function<void(std::size_t)>& show) {
    require_one_batch(items, shards);
    LinesByFile by_file = lines_by_file(shards);
    MergedShards merged;
    for (const BatchItem& item : items) {
        std::vector<ShardLine> lines;
        if (auto found = by_file.extract(item.file)) lines = std::move(found.mapped());
        merged.meshes.push_back(join(item, last_lines(lines)));
        if (lines.size() > 1)
            for (const ShardLine& each : lines) merged.meshes.back().repeated.push_back(each.shard->folder);
        show(merged.meshes.size());
    }
    for (const auto& [file, lines] : by_file)
        for (const ShardLine& each : lines)
            merged.strangers.push_back(each.shard->folder.string() + ": " + std::string(file));
    require_one_template(merged.meshes);
    return merged;
}

} // namespace skelgen::cli
