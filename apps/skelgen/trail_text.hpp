#pragma once

#include <filesystem>

#include <skelgen/search/trail.hpp>

namespace skelgen::cli {

/// Prints to standard error what was tried on a mesh, in order, and what came of it, a line each.
void print_trail(const std::filesystem::path& mesh, const search::Trail& trail);

} // namespace skelgen::cli
