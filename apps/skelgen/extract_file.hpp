#pragma once

#include <cstdint>
#include <filesystem>
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

/// Reads a mesh and finds its skeleton: what `extract` and `batch` both do, so that they give the same bytes.
/// \throws Error as `io::read_mesh` and `extract_skeleton`, without the file's name.
[[nodiscard]] FileExtraction extract_file(const MeshInput& mesh, const ExtractOptions& options);

} // namespace skelgen::cli
