#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

#include <skelgen/extract.hpp>
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

/// Reads a mesh and finds its skeleton: what `extract` and `batch` both do, so that they give the same bytes. With
/// fingers the file's text has those; the skeleton beside it has none. \throws Error as `io::read_mesh` and
/// `extract`, without the file's name.
[[nodiscard]] FileExtraction extract_file(const MeshInput& mesh, const ExtractOptions& options,
                                          Fingers fingers = Fingers::off);

} // namespace skelgen::cli
