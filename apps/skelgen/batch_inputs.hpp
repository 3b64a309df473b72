#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace skelgen::cli {

/// One mesh of a batch.
struct BatchItem {
    std::filesystem::path mesh;   ///< where it is
    std::string file;             ///< its path within the input that named it, as `printable`: no two have the same
    std::filesystem::path output; ///< where its skeleton goes, see `find_batch_items`
    std::string fault;            ///< why there is nothing to be done with it; empty for meshes
    std::filesystem::path folder; ///< the output folder, which `output` lies in
    int component = 0;            ///< the body in it, as `PrepareOptions::component`
};

/// The path as text in UTF-8, another one for each path: a backslash becomes two, and in a path that is no UTF-8 every
/// byte beyond ASCII \xHH.
[[nodiscard]] std::string printable(const std::filesystem::path& path);

/// Finds the meshes that `inputs` name, ordered by `file`, each output once:
/// - a folder: all meshes in it and below, by extension; `file` is relative to the folder;
/// - a pattern (*, ?, [abc], ** for any folders): all meshes that match, or lie in a folder that does; `file` is
///   relative to the folders before the first wildcard;
/// - anything else is a mesh, whether it can be read or not; `file` is its name.
/// Hidden files and folders are left out, links to folders are not followed. A folder that cannot be read is an item
/// with a fault. `output` is OUTPUT_FOLDER/`file` with the extension .json in place of the mesh's; behind it where
/// several meshes differ in their extension alone (x.off.json beside x.ply.json).
/// \throws Error bad_input when an input names no mesh, usage when two different meshes have the same `file`.
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
