#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "batch_inputs.hpp"
#include "batch_summary.hpp"

namespace skelgen::cli {

/// A folder that a shard of a batch has written to, and what its summary says.
struct ShardFolder {
    std::filesystem::path folder;
    SummaryContent summary;
};

/// What all shards together have made of one mesh.
struct MergedMesh {
    SummaryLine line;                            ///< a shard's, or one whose status is of those below
    std::filesystem::path shard;                 ///< the folder that holds the results; empty where no shard has any
    std::string skeleton_template;               ///< what the skeleton was matched to; empty where there is none
    std::vector<std::filesystem::path> repeated; ///< where several lines tell of it, the folder of each; or empty
};

/// Statuses that no shard gives: no shard tells of the mesh, or its skeleton is not there as it was written;
/// and, shards have found different skeletons in it.
inline constexpr const char* status_missing = "missing";
inline constexpr const char* status_contradiction = "contradiction";

struct MergedShards {
    std::vector<MergedMesh> meshes;     ///< one per item, in their order
    std::vector<std::string> strangers; ///< "FOLDER: FILE" of each line that tells of no mesh of the batch
};

/// Joins what the shards of a batch say of its meshes. A skeleton counts where its file is what the summary says was
/// written; a mesh that several shards have done with one result has it; a skeleton goes before a failure elsewhere,
/// the first of several failures is taken. `items` have outputs relative to any shard's folder. `show` is told how many
/// are done after each. Reads every skeleton, but no mesh. O(lines log lines). \throws Error bad_input when a shard
/// tells of other meshes only, or shards have matched different templates: they are of different batches.
[[nodiscard]] MergedShards merge_shards(const std::vector<BatchItem>& items, const std::vector<ShardFolder>& shards,
                                        const std::function<void(std::size_t)>& show);

} // namespace skelgen::cli
