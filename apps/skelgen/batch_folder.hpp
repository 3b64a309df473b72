#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "batch_inputs.hpp"
#include "batch_summary.hpp"

namespace skelgen::cli {

/// Removes what an earlier run left of these meshes in their output folder: skeletons, further results (`parts`, and
/// those that the summary says it has written) and summary lines. Nothing of it may pass for a result of the run that
/// begins. What cannot be removed stays. \throws Error as `BatchSummary::update`.
void start_over(const std::vector<BatchItem>& items, const BatchSummary& summary,
                const std::vector<std::string>& parts);

/// Removes temporary files of processes that are no more from the folder and from those of the meshes' outputs.
void clean_up(const std::vector<BatchItem>& items, const std::filesystem::path& output_folder);

} // namespace skelgen::cli
