#pragma once

#include <string>

#include "command_outline.hpp"

namespace skelgen::cli {

/// The options of a command of the program as a part of a page of the manual, in Markdown.
[[nodiscard]] std::string markdown_page(const CommandOutline& program, const CommandOutline& command);

} // namespace skelgen::cli
