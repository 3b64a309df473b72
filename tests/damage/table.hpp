#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace skelgen::damage {

/// How the bodies damaged in one way do.
struct Row {
    std::string kind; ///< or "clean"
    std::size_t meshes = 0;
    std::size_t solved = 0;          ///< of two bodies: refused with their count
    double mean_error = 0;           ///< of the solved ones' joints, in geodesic diameters; 0 where there are none
    std::size_t wrong_sure = 0;      ///< skeletons that do not solve it, with a confidence above 0.8
    double worst_seconds = 0;        ///< wall clock
    std::string slowest;             ///< the mesh that took so long
    std::vector<std::string> failed; ///< the meshes not solved, with what became of them
};

/// Scores FOLDER/clean/<name>.json and FOLDER/skeletons/<kind>/<name>.json, as `skelgen batch` has written them from
/// FOLDER/meshes/<kind>/<name>.*, against TRUTH/<name>.json, where <name> may have folders in it. Kinds without meshes
/// are left out. \throws Error bad_input when a truth or a summary cannot be read.
[[nodiscard]] std::vector<Row> score(const std::filesystem::path& truth, const std::filesystem::path& folder);

[[nodiscard]] std::string to_table(const std::vector<Row>& rows);

} // namespace skelgen::damage
