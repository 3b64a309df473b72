#pragma once

#include <string>
#include <vector>

#include "batch_inputs.hpp"
#include "batch_summary.hpp"

namespace skelgen::cli {

/// A page (`render::report_page`) of what a folder's summary and the pictures beside the skeletons say of these meshes.
[[nodiscard]] std::string batch_report(const std::string& title, const std::vector<BatchItem>& items,
                                       const SummaryLines& lines);

} // namespace skelgen::cli
