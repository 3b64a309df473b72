#pragma once

namespace skelgen::cli {

/// Runs the program as its `main` does. Changes how the whole process takes memory and signals: it is to do nothing
/// else. What it could not do is one line on standard error. \return the exit status.
[[nodiscard]] int run_program(int argc, char** argv);

} // namespace skelgen::cli
