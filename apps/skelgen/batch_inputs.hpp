#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace skelgen::cli {

/// One mesh of a batch.
struct BatchItem {
    std::filesystem::path mesh;   ///< where it is
    std::string file;             ///< its path within the input that named it; tells it apart in the summary
    std::filesystem::path output; ///< where its skeleton goes: OUTPUT_FOLDER/`file` with the extension .json
};

/// Finds the meshes that `inputs` name, ordered by `file`, each output once:
/// - a folder: all meshes in it and below, by extension; `file` is relative to the folder;
/// - a pattern (*, ?, [abc], ** for any folders): all meshes that match, or lie in a folder that does; `file` is
///   relative to the folders before the first wildcard;
/// - anything else is a mesh, whether it can be read or not; `file` is its name.
/// Hidden files and folders are left out, links to folders are not followed.
/// \throws Error bad_input when an input names no mesh or a folder cannot be read, usage when two different meshes
/// would
///         be written to the same output.
[[nodiscard]] std::vector<BatchItem> find_batch_items(const std::vector<std::string>& inputs,
                                                      const std::filesystem::path& output_folder);

/// Part `number` (1 to `count`) of a batch that several machines share: every item is in exactly one part.
struct Shard {
    std::size_t number = 1;
    std::size_t count = 1;
};

/// Reads "K/N". \throws Error usage when it is not that, or K is not from 1 to N.
[[nodiscard]] Shard parse_shard(const std::string& text);

[[nodiscard]] std::vector<BatchItem> take_shard(const std::vector<BatchItem>& items, const Shard& shard);

} // namespace skelgen::cli
