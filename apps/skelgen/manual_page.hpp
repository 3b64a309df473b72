#pragma once

#include <string>

#include "command_outline.hpp"

namespace skelgen::cli {

/// What the manual page of a command is called: skelgen-extract; that of the program itself skelgen.
[[nodiscard]] std::string manual_page_name(const CommandOutline& program, const CommandOutline& command);

/// The manual page of a command of the program, or of the program itself, in the language of man(7).
[[nodiscard]] std::string manual_page(const CommandOutline& program, const CommandOutline& command);

} // namespace skelgen::cli
