#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <skelgen/core/skeleton_template.hpp>

#include "batch_inputs.hpp"
#include "compared_file.hpp"
#include "fitted_file.hpp"

namespace skelgen::cli {

/// The names of the further results that a batch can write of each mesh, as --also takes them: those of the
/// commands that write them alone. Without pictures where the program is built without them.
[[nodiscard]] const std::vector<std::string>& batch_part_names();

/// What each of them is and what its files are called, for the help.
[[nodiscard]] std::string batch_parts_text();

/// Splits "rig,measure", each part once. \throws Error usage when one is no such name.
[[nodiscard]] std::vector<std::string> parse_batch_parts(const std::string& text);

/// Whether a part shows the curve, too: other bodies may be found without it.
[[nodiscard]] bool part_has_curve(std::string_view part);

/// Where a part goes: into a folder of its name in the output folder, there as the skeleton's file but for an extension
/// of its own.
[[nodiscard]] std::filesystem::path part_file(const BatchItem& item, std::string_view part);

/// Refuses parts that would replace one of the meshes, or two results that would have the same file; `others` are
/// results of all meshes together. \throws Error usage, naming the file.
void require_own_files(const std::vector<BatchItem>& items, const std::vector<std::string>& parts,
                       const std::vector<std::filesystem::path>& others);

/// What parts need beside the body.
struct PartContext {
    SkeletonTemplate skeleton_template;
    std::optional<ComparedFile> template_body = std::nullopt; ///< there where the part correspond is asked for
};

/// Writes a part to its file. Returns what is to be said of it, empty where that is nothing. \throws Error as the
/// command of its name, with the file's name in front.
[[nodiscard]] std::string write_part(std::string_view part, const BatchItem& item, const FittedFile& body,
                                     const PartContext& context);

/// Draws a mesh in which no skeleton was found, as the part render, with the reason below. \throws Error as
/// `read_mesh`, and as `write_part`.
void draw_refused(const BatchItem& item, const std::string& reason);

} // namespace skelgen::cli
