#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <skelgen/extract.hpp>
#include <skelgen/extract_hinted.hpp>
#include <skelgen/io/skeleton_json.hpp>

#include "fitted_file.hpp"

namespace skelgen::cli {

/// What came out of one mesh file.
struct FileExtraction : FittedFile {
    io::SkeletonProvenance provenance;
    std::string json; ///< the skeleton file's text
};

/// Whether the digits of the hands are looked for, or only where they show.
enum class Fingers { off, on, automatic };

/// Those that `--fingers` knows: "auto", "off", "on".
[[nodiscard]] const std::map<std::string, Fingers>& fingers_by_name();

/// A skeleton, perhaps with digits.
struct FingeredSkeleton {
    KinematicSkeleton<double> skeleton;
    std::vector<std::pair<std::string, std::vector<std::string>>> fused = {}; ///< as `hands::fused_digits`
};

/// What was found in the mesh, with the digits that are wanted, and perhaps toes. \throws Error usage where they are
/// and the skeleton is none of human21.
[[nodiscard]] FingeredSkeleton with_fingers(const TriangleMesh<double>& mesh, const Extraction<double>& found,
                                            Fingers fingers, bool toes = false);

/// The template that is looked for where this one is asked for, and whether digits are then: human51 is human21 with
/// them. \throws Error usage where fingers or toes are asked for that do not go with the template.
[[nodiscard]] std::pair<std::string, Fingers> template_and_fingers(const std::string& skeleton_template,
                                                                   const std::string& fingers, bool toes = false);

/// Reads a mesh and finds its skeleton: what `extract` and `batch` both do, so that they give the same bytes. With
/// fingers or toes the file's text has those; the skeleton beside it has none. With hints as `extract_hinted`. \throws
/// Error as `io::read_mesh` and `extract`, without the file's name.
[[nodiscard]] FileExtraction extract_file(const MeshInput& mesh, const ExtractOptions& options,
                                          Fingers fingers = Fingers::off, const std::vector<Hint>& hints = {},
                                          bool toes = false);

} // namespace skelgen::cli
