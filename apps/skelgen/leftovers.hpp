#pragma once

#include <filesystem>

namespace skelgen::cli {

/// Removes the temporary files that `write_file_atomically` could not clean up in `folder` because its process was
/// killed; those of processes that still run stay. Does nothing if the folder cannot be read.
void remove_leftovers(const std::filesystem::path& folder);

} // namespace skelgen::cli
