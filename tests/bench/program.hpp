#pragma once

#include <string>
#include <vector>

namespace skelgen::bench {

/// What a run of the program took, milliseconds: on all processors together, and by the clock.
struct ProgramTime {
    double cpu = 0, wall = 0;
};

/// Runs the program of this build, silently. \throws std::runtime_error when it cannot be run or fails.
[[nodiscard]] ProgramTime run_program(const std::vector<std::string>& arguments);

} // namespace skelgen::bench
