#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <skelgen/evaluation/curve_error.hpp>

namespace skelgen::regression {

/// How the curve of one thing of tubes compares with its axis.
struct TubeScore {
    std::string name;
    evaluation::CurveError error;
};

/// Makes all tubes: FOLDER/<name>.off, FOLDER/<name>.json. They are apart from the bodies: their truth is another one.
void make_tubes(const std::filesystem::path& folder, unsigned jobs);

/// Finds the curve of every tube that `make_tubes` has put into the folder and compares it with the axis. What fails on
/// the way scores as a curve without nodes.
[[nodiscard]] std::vector<TubeScore> measure_tubes(const std::filesystem::path& folder, unsigned jobs);

/// A line for each tube.
[[nodiscard]] std::string to_table(const std::vector<TubeScore>& scores);

} // namespace skelgen::regression
