#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace skelgen::render {

/// What a report says of one mesh.
struct ReportEntry {
    std::string file;                  ///< its name, shown as it is
    std::string status;                ///< "ok", or in a word why there is no skeleton
    std::vector<std::string> messages; ///< what has failed and why; none: all is well
    std::vector<std::string> warnings;
    double seconds = 0;
    std::int64_t faces = 0;
    std::optional<double> sides_confidence; ///< 0 to 1: that left and right are told apart rightly
    std::optional<double> least_confidence; ///< 0 to 1: of the joint that is least certain
    std::string picture;                    ///< the bytes of a PNG; empty: none
};

/// A page of HTML that shows what became of many meshes: failures first, then what has warnings, then the least
/// certain; with pictures, reasons, times and confidences, and fields that filter and sort. It is one file that needs
/// nothing else and no network; without scripts it shows all of it in that order. Linear, but for the sorting.
[[nodiscard]] std::string report_page(const std::string& title, std::vector<ReportEntry> entries);

} // namespace skelgen::render
