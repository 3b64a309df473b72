#pragma once

#include <string>

#include "command_outline.hpp"

namespace skelgen::cli {

// Scripts that have a shell complete the program's commands, options, the values of options that have few, and the
// names of files and folders for all others that are not numbers.

[[nodiscard]] std::string bash_completion(const CommandOutline& program);
[[nodiscard]] std::string zsh_completion(const CommandOutline& program);
[[nodiscard]] std::string fish_completion(const CommandOutline& program);

} // namespace skelgen::cli
